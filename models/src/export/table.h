/* @ROBOT@
 *
 * Made by: @COMMAND@
 * Tip, markers and inverse over the actuator's gauge pressure, @LOW_KPA@ to @HIGH_KPA@ kPa, at a body pressure of @BODY@ kPa.
 * @HISTORY@
 *
 * Largest differences from the model, over @PRESSURES@ pressures:
 *   tip      @TIP@ mm (@TIP_SHARE@ of the length, @LENGTH@ mm)
 *   angle    @ANGLE@ deg
 *   markers  @MARKER_BOUND@
 *   slope    @SLOPE@ mm/kPa of the tip's height, from @SLOPE_FROM@ kPa on
 * The model itself is a prediction: how far a robot is from it only measurements tell.
 *
 * The actuator is flat up to @OPEN_KPA@ kPa. One pressure belongs to a height of the tip @RISING@.
 * Constants: @BYTES@ bytes, single precision, in flash on AVR. C99 and C++, nothing allocated, no state.
 * Compile @FILE@.c with your program and link with -lm. With -DIBR_REAL=float everything is computed in single precision,
 * for a processor that has no other; the differences above are then larger by about 1e-6 of the length. */
#ifndef UPPER_H
#define UPPER_H

#ifndef IBR_REAL
#define IBR_REAL double
#endif

#define UPPER_MARKERS @MARKERS@

#ifdef __cplusplus
extern "C" {
#endif

/* Pose of the tip, or its slope by the pressure. */
typedef struct {
    IBR_REAL x_m;       /* along the straight body */
    IBR_REAL y_m;       /* towards the actuator */
    IBR_REAL angle_rad; /* total bend */
} NAME_tip_t;

/* Each returns 0; or 1 if the pressure or the height is outside the range, and then gives the nearest end. */

/* Tip at a pressure in Pa. */
int NAME_tip(IBR_REAL p_pa, NAME_tip_t *tip);
/* Its slope, per Pa; 0 where the actuator is flat, large where it begins to open. */
int NAME_slope(IBR_REAL p_pa, NAME_tip_t *per_pa);
/* Markers x, y, x, y ... in m at a pressure in Pa; 2 * UPPER_MARKERS numbers. */
int NAME_markers(IBR_REAL p_pa, IBR_REAL *xy_m);
/* Pressure in Pa at which the tip is at a height in m. */
int NAME_pressure(IBR_REAL y_m, IBR_REAL *p_pa);

#ifdef __cplusplus
}
#endif

#endif
