/* Reads "p y" in SI, a line each, and prints what the table of robot.c answers; then the nanoseconds of a call, best of ten. */
#define _POSIX_C_SOURCE 199309L
#include "robot.h"
#include <stdio.h>
#include <time.h>

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* What keeps the compiler from leaving calls out. */
static volatile double kept;

static double best(int which)
{
    enum { CALLS = 20000 };
    double least = 1.0;
    for (int run = 0; run < 10; run++) {
        const double start = seconds();
        double sum = 0;
        for (int i = 0; i < CALLS; i++) {
            robot_tip_t tip = {0, 0, 0};
            double p = 0;
            if (which == 0)
                robot_tip(40e3 * i / CALLS, &tip);
            else if (which == 1)
                robot_slope(40e3 * i / CALLS, &tip);
            else
                robot_pressure(0.06 * i / CALLS, &p);
            sum += tip.y_m + p;
        }
        kept = sum;
        const double each = (seconds() - start) / CALLS;
        if (each < least)
            least = each;
    }
    return 1e9 * least;
}

int main(void)
{
    double p, y, found, markers[2 * ROBOT_MARKERS + 1];
    robot_tip_t tip, slope;
    while (scanf("%lf %lf", &p, &y) == 2) {
        int outside = robot_tip(p, &tip) + 2 * robot_pressure(y, &found);
        robot_slope(p, &slope);
        robot_markers(p, markers);
        printf("%d %.17g %.17g %.17g %.17g %.17g", outside, tip.x_m, tip.y_m, tip.angle_rad, slope.y_m, found);
        for (int i = 0; i < 2 * ROBOT_MARKERS; i++)
            printf(" %.17g", markers[i]);
        printf("\n");
    }
    printf("%.1f %.1f %.1f\n", best(0), best(1), best(2));
    return 0;
}
