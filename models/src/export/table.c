/* @ROBOT@, made by ibr: see @FILE@.h for what it is and how exact. */
#include "@FILE@.h"
#include <math.h>

/* Constants stay in flash on AVR. */
#ifdef __AVR__
#include <avr/pgmspace.h>
#define IN_FLASH PROGMEM
#define READ(place) ((IBR_REAL)pgm_read_float(&(place)))
#else
#define IN_FLASH
#define READ(place) ((IBR_REAL)(place))
#endif

/* sqrtf where IBR_REAL is float: C++ and C99 have no common name for both. */
#define real_is_float 1
#define JOINED(a, b) a##b
#define REAL_IS(real) JOINED(real_is_, real)
#if REAL_IS(IBR_REAL)
#define ROOT sqrtf
#else
#define ROOT sqrt
#endif

enum { PIECES = @PIECES@, TERMS = @DEGREE@ + 1, OUTPUTS = @OUTPUTS@, FIRST = @FIRST@, LAST = @LAST@ };

static const IBR_REAL low_pa = (IBR_REAL)@LOW@, high_pa = (IBR_REAL)@HIGH@, open_pa = (IBR_REAL)@OPEN@;

/* Ends of the pieces in u = sqrt((p - open)/(high - open)). */
static const float edges[PIECES + 1] IN_FLASH = {
@EDGES@};

/* Rising powers of t, which runs from -1 to 1 over a piece: x, y, angle, then x, y of each marker; m and rad. */
static const float coefficients[PIECES * OUTPUTS * TERMS] IN_FLASH = {
@COEFFICIENTS@};

/* A place in the table: piece, t, and u. */
typedef struct {
    int piece;
    IBR_REAL t, u;
} place_t;

static int place(IBR_REAL p_pa, place_t *at)
{
    /* Written so that what is no number is outside. */
    const int inside = p_pa >= low_pa && p_pa <= high_pa;
    int low = 0, high = PIECES - 1;
    if (!(p_pa >= low_pa))
        p_pa = low_pa;
    if (p_pa > high_pa)
        p_pa = high_pa;
    at->u = p_pa > open_pa ? ROOT((p_pa - open_pa) / (high_pa - open_pa)) : 0;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (READ(edges[middle + 1]) < at->u)
            low = middle + 1;
        else
            high = middle;
    }
    at->piece = low;
    at->t = (2 * at->u - READ(edges[low]) - READ(edges[low + 1])) / (READ(edges[low + 1]) - READ(edges[low]));
    return !inside;
}

/* Value of an output, and its slope by t. */
static IBR_REAL value(int piece, int output, IBR_REAL t, IBR_REAL *slope)
{
    const float *c = coefficients + (piece * OUTPUTS + output) * TERMS;
    IBR_REAL sum = 0, rise = 0;
    for (int k = TERMS - 1; k >= 0; k--) {
        rise = rise * t + sum;
        sum = sum * t + READ(c[k]);
    }
    *slope = rise;
    return sum;
}

int NAME_tip(IBR_REAL p_pa, NAME_tip_t *tip)
{
    place_t at;
    IBR_REAL unused;
    const int outside = place(p_pa, &at);
    tip->x_m = value(at.piece, 0, at.t, &unused);
    tip->y_m = value(at.piece, 1, at.t, &unused);
    tip->angle_rad = value(at.piece, 2, at.t, &unused);
    return outside;
}

int NAME_slope(IBR_REAL p_pa, NAME_tip_t *per_pa)
{
    place_t at;
    const int outside = place(p_pa, &at);
    const IBR_REAL per = (READ(edges[at.piece + 1]) - READ(edges[at.piece])) * at.u * (high_pa - open_pa);
    /* A flat actuator has none. */
    const IBR_REAL rate = at.u > 0 ? 1 / per : 0;
    IBR_REAL slope[3];
    for (int i = 0; i < 3; i++)
        value(at.piece, i, at.t, &slope[i]);
    per_pa->x_m = slope[0] * rate;
    per_pa->y_m = slope[1] * rate;
    per_pa->angle_rad = slope[2] * rate;
    return outside;
}

int NAME_markers(IBR_REAL p_pa, IBR_REAL *xy_m)
{
    place_t at;
    IBR_REAL unused;
    const int outside = place(p_pa, &at);
    for (int i = 0; i < 2 * UPPER_MARKERS; i++)
        xy_m[i] = value(at.piece, 3 + i, at.t, &unused);
    return outside;
}

/* Newton's method between two places on either side, halving where it would leave them. */
static IBR_REAL meet(int piece, IBR_REAL y_m)
{
    IBR_REAL low = -1, high = 1, t = 0;
    for (int i = 0; i < 40; i++) {
        IBR_REAL slope;
        const IBR_REAL miss = value(piece, 1, t, &slope) - y_m;
        const IBR_REAL next = t - miss / slope;
        if (miss > 0)
            high = t;
        else
            low = t;
        if (next - t < (IBR_REAL)1e-7 && t - next < (IBR_REAL)1e-7)
            return next;
        t = next > low && next < high ? next : (low + high) / 2;
    }
    return t;
}

int NAME_pressure(IBR_REAL y_m, IBR_REAL *p_pa)
{
    IBR_REAL unused, u, t;
    int low = FIRST, high = LAST - 1, outside = 0;
    if (FIRST == LAST) {
        *p_pa = low_pa;
        return 1;
    }
    if (!(y_m >= value(FIRST, 1, -1, &unused))) {
        outside = 1;
        t = -1;
        high = low;
    } else if (y_m > value(LAST - 1, 1, 1, &unused)) {
        outside = 1;
        t = 1;
        low = high;
    } else {
        while (low < high) {
            const int middle = (low + high) / 2;
            if (value(middle, 1, 1, &unused) < y_m)
                low = middle + 1;
            else
                high = middle;
        }
        t = meet(low, y_m);
    }
    u = (READ(edges[low]) + READ(edges[low + 1]) + t * (READ(edges[low + 1]) - READ(edges[low]))) / 2;
    *p_pa = open_pa + u * u * (high_pa - open_pa);
    return outside;
}
