/* A control loop that follows a wanted path of the tip with two actuators.
 *
 *   cc controller.c -I.. -L../../target/release -l:libibr_capi.a -lm -lpthread -ldl -o controller && ./controller
 *
 * Each cycle asks the model for the pressures of the next target, within what the valves can change in a cycle, and
 * corrects the target by what the tip missed so far (an integral), because no robot is its model. The robot here is
 * played by the same model with a softer supply: a tenth of every pressure is lost on the way. */
#include "ibr.h"
#include <math.h>
#include <stdio.h>

static const char scenario[] =
    "name = \"two actuators\"\n"
    "[body]\nradius_mm = 40\nlength_mm = 360\npressure_kpa = 2\nbending_stiffness_nm2 = 0.5\n"
    "[actuator]\nkind = \"epam\"\nlength_mm = 60\nwidth_mm = 60\ncount = 6\nmax_pressure_kpa = 50\n"
    "[[zone]]\nfrom_mm = 180\nto_mm = 360\nchannel = 1\n";

static ibr_robot *opened(const char *text)
{
    char error[200];
    ibr_robot *robot = ibr_open(text, error, sizeof error);
    if (robot == NULL)
        fprintf(stderr, "%s\n", error);
    return robot;
}

int main(void)
{
    enum { CYCLES = 200 };
    const double cycle_s = 0.05, rate_pa_per_s = 60e3, gain = 0.2, delivered = 0.9;
    ibr_robot *model = opened(scenario), *robot = opened(scenario);
    if (model == NULL || robot == NULL)
        return 1;
    const double body_pa = ibr_body_pressure(model);
    double set_pa[IBR_CHANNELS] = {0}, learned[2] = {0, 0};
    printf("t_s,wanted_x_mm,wanted_y_mm,x_mm,y_mm,miss_mm,p0_kpa,p1_kpa,held0,held1\n");
    for (int i = 0; i < CYCLES; i++) {
        /* From the straight robot to a circle of 10 mm, once around. */
        const double t = i * cycle_s, turn = 6.283185307179586 * fmax(0.0, t - 3.0) / 6.0, in = fmin(1.0, t / 3.0);
        const double x = 0.36 + in * (0.3 - 0.36) - 0.01 * sin(turn), y = in * 0.135 - 0.01 * (1.0 - cos(turn));
        ibr_steered next;
        if (ibr_steer(model, body_pa, x + learned[0], y + learned[1], set_pa, rate_pa_per_s * cycle_s, &next) != IBR_OK) {
            fprintf(stderr, "at %.2f s: %s\n", t, ibr_error(model));
            return 1;
        }
        double there_pa[IBR_CHANNELS];
        for (int k = 0; k < IBR_CHANNELS; k++) {
            set_pa[k] = next.actuator_pa[k];
            there_pa[k] = delivered * set_pa[k];
        }
        ibr_tip tip;
        if (ibr_predict(robot, body_pa, there_pa, &tip, NULL) != IBR_OK)
            return 1;
        /* While a valve holds the tip back, the miss teaches nothing about the model. */
        if (next.held[0] == 0 && next.held[1] == 0) {
            learned[0] += gain * (x - tip.x_m);
            learned[1] += gain * (y - tip.y_m);
        }
        printf("%.2f,%.2f,%.2f,%.2f,%.2f,%.3f,%.2f,%.2f,%d,%d\n", t, 1e3 * x, 1e3 * y, 1e3 * tip.x_m, 1e3 * tip.y_m,
               1e3 * hypot(x - tip.x_m, y - tip.y_m), 1e-3 * set_pa[0], 1e-3 * set_pa[1], next.held[0], next.held[1]);
    }
    ibr_close(model);
    ibr_close(robot);
    return 0;
}
