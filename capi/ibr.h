// C interface of ibr (MIT OR Apache-2.0). SI units, gauge pressures. A robot is put together once by ibr_open; every other call
// allocates nothing and returns IBR_OK or why not, with words in ibr_error. One handle belongs to one thread at a time.

#ifndef IBR_H
#define IBR_H

#include <stddef.h>
#include <stdint.h>

// Supply channels; every array of pressures has so many; values for channels that feed nothing are ignored.
#define IBR_CHANNELS 4

// The call did what was asked; its results are written.
#define IBR_OK 0

// An argument that means nothing: a null pointer, a negative pressure, a place that is not finite.
#define IBR_BAD_ARGUMENT 1

// The robot has no equilibrium at these pressures.
#define IBR_UNSOLVED 2

// The tip cannot reach its target; the error text has the range in reach.
#define IBR_OUT_OF_REACH 3

// A fault in the library: please report it with its text.
#define IBR_FAULT 4

// A robot, and the buffers of its computations.
typedef struct ibr_robot ibr_robot;

// Pose of the end of the robot's centre line.
typedef struct ibr_tip {
  // Coordinate along the undeformed body, m.
  double x_m;
  // Coordinate across the undeformed body, towards the actuator, m.
  double y_m;
  // Total bending angle from base to tip, rad.
  double angle_rad;
} ibr_tip;

// Slopes of the tip's pose by the pressure of one channel; not a number where an actuator of the channel is flat.
typedef struct ibr_slope {
  // Slope of x_m by the channel's pressure, m/Pa.
  double x_per_pa;
  // Slope of y_m by the channel's pressure, m/Pa.
  double y_per_pa;
  // Slope of angle_rad by the channel's pressure, rad/Pa.
  double angle_per_pa;
} ibr_slope;

// Pressures that bring the tip nearest to its target.
typedef struct ibr_steered {
  // Pressure of each channel, Pa; 0 where one feeds nothing.
  double actuator_pa[IBR_CHANNELS];
  // Distance of the tip from there, m.
  double miss_m;
  // Per channel: -1 its least pressure keeps the tip from coming nearer, 1 its largest does, 0 neither.
  int32_t held[IBR_CHANNELS];
} ibr_steered;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Puts a robot together from the text of a scenario (docs/scenario.md) or the name of a shipped one: spam, cpam, epam, fpam.
// Null if it is refused; error, if not null, then gets the reason, cut to error_size bytes with the closing zero.
//
// scenario is null or ends with a zero; error is null or has error_size bytes.
struct ibr_robot *ibr_open(const char *scenario,
                           char *error,
                           size_t error_size);

// Gives a robot back; null is nothing.
//
// robot is null or comes from ibr_open, and is not used afterwards.
void ibr_close(struct ibr_robot *robot);

// Why the last call with this robot failed; empty if it did not. Good until the next call with it.
//
// robot is null or comes from ibr_open.
const char *ibr_error(const struct ibr_robot *robot);

// Body pressure of the scenario in Pa; not a number for null.
//
// robot is null or comes from ibr_open.
double ibr_body_pressure(const struct ibr_robot *robot);

// Largest actuator pressure of the scenario in Pa, up to which inverses search; not a number for null.
//
// robot is null or comes from ibr_open.
double ibr_largest_pressure(const struct ibr_robot *robot);

// Number of markers of the scenario.
//
// robot is null or comes from ibr_open.
size_t ibr_marker_count(const struct ibr_robot *robot);

// Tip at the pressures of the body and of the channels, in Pa, on the first loading from rest. markers_xy_m, if not null,
// gets x, y of every marker.
//
// robot is null or comes from ibr_open; actuator_pa has IBR_CHANNELS numbers, tip is one and markers_xy_m has
// twice as many numbers as there are markers, or any of them is null.
int32_t ibr_predict(struct ibr_robot *robot,
                    double body_pa,
                    const double *actuator_pa,
                    struct ibr_tip *tip,
                    double *markers_xy_m);

// Pressure in Pa, the same in every channel, at which the tip has a height in m.
//
// robot is null or comes from ibr_open; pressure_pa is null or a number.
int32_t ibr_pressure_for_height(struct ibr_robot *robot,
                                double body_pa,
                                double y_m,
                                double *pressure_pa);

// Pressure in Pa, the same in every channel, at which the robot is bent by an angle in rad.
//
// As ibr_pressure_for_height.
int32_t ibr_pressure_for_angle(struct ibr_robot *robot,
                               double body_pa,
                               double angle_rad,
                               double *pressure_pa);

// Slopes of the tip's pose by the pressure of every channel.
//
// robot is null or comes from ibr_open; actuator_pa and slopes are null or have IBR_CHANNELS entries.
int32_t ibr_jacobian(struct ibr_robot *robot,
                     double body_pa,
                     const double *actuator_pa,
                     struct ibr_slope *slopes);

// Pressures from 0 to the largest of the scenario that bring the tip nearest to a place in m. now_pa, if not null, are the
// present pressures, from which none changes by more than change_pa: a rate times the time of a cycle.
//
// robot is null or comes from ibr_open; now_pa is null or has IBR_CHANNELS numbers; steered is null or one.
int32_t ibr_steer(struct ibr_robot *robot,
                  double body_pa,
                  double x_m,
                  double y_m,
                  const double *now_pa,
                  double change_pa,
                  struct ibr_steered *steered);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* IBR_H */
