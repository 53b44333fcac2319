/* @ROBOT@, made by ibr: a unit for co-simulation (FMI 3.0) around the table in @FILE@.c.
 *
 * Input p_act_kpa is the set pressure, p_arrived_kpa what the supply line lets through, at once without one; it starts at 0.
 * Outputs follow from what arrived. Outside the table's range they are those of its nearest end, and the status is a warning. */
#include "@FILE@.h"
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

enum { OK = 0, WARNING = 1, ERROR = 3 };
/* Value references: those of the markers follow in pairs. */
enum { TIME, SET_KPA, ARRIVED_KPA, TIP_X_MM, TIP_Y_MM, ANGLE_DEG, FIRST_MARKER, ALL = FIRST_MARKER + 2 * UPPER_MARKERS };

/* The supply line: time constant of the valve, 0 at once; flow p0 C/V in 1/s, 0 at once; critical pressure ratio. */
static const double valve_time_s = @VALVE_TIME@, flow_per_s = @FLOW@, critical_ratio = @RATIO@;
static const double room_pa = 101325.0, laminar = 0.999, reached_pa = 1e-3;

typedef struct {
    double time_s, set_pa, valve_pa, arrived_pa;
} unit_t;

/* Flow over the choked one. */
static double share(double ratio)
{
    const double most = ratio < laminar ? ratio : laminar;
    const double above = (most > critical_ratio ? most - critical_ratio : 0) / (1 - critical_ratio);
    const double open = sqrt(1 - above * above);
    return ratio < laminar ? open : open * (1 - ratio) / (1 - laminar);
}

static double valve(const unit_t *unit, double t_s)
{
    return valve_time_s > 0 ? unit->set_pa + (unit->valve_pa - unit->set_pa) * exp(-t_s / valve_time_s) : unit->set_pa;
}

static double rate(const unit_t *unit, double t_s, double p_pa)
{
    const double from = valve(unit, t_s);
    const double up = fmax(from, p_pa) + room_pa, down = fmin(from, p_pa) + room_pa;
    return (from < p_pa ? -1 : 1) * flow_per_s * up * share(down / up);
}

/* Lets a time pass at the set pressure: the valve exactly, the line by the classical method of Runge and Kutta. */
static void pass(unit_t *unit, double dt_s)
{
    double p = unit->arrived_pa;
    if (flow_per_s > 0) {
        const double count = fmax(1, ceil(8 * flow_per_s * share(laminar) / (1 - laminar) * dt_s)), h = dt_s / count;
        for (double done = 0; done < count; done += 1) {
            const double t = done * h;
            if (fabs(p - unit->set_pa) < reached_pa && fabs(valve(unit, t) - unit->set_pa) < reached_pa) {
                p = unit->set_pa;
                break;
            }
            const double k1 = rate(unit, t, p), k2 = rate(unit, t + h / 2, p + h / 2 * k1);
            const double k3 = rate(unit, t + h / 2, p + h / 2 * k2), k4 = rate(unit, t + h, p + h * k3);
            p += h / 6 * (k1 + 2 * (k2 + k3) + k4);
        }
    } else {
        p = valve(unit, dt_s);
    }
    unit->valve_pa = valve(unit, dt_s);
    unit->arrived_pa = p;
    unit->time_s += dt_s;
}

EXPORTED const char *fmi3GetVersion(void)
{
    return "3.0";
}

EXPORTED void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible, bool logging,
                                           bool events, bool early, const uint32_t *needed, size_t count, void *environment,
                                           void (*log)(void), void (*update)(void))
{
    (void)name, (void)resources, (void)visible, (void)logging, (void)events, (void)early;
    (void)needed, (void)count, (void)environment, (void)log, (void)update;
    return token && strcmp(token, "@TOKEN@") == 0 ? calloc(1, sizeof(unit_t)) : NULL;
}

EXPORTED void fmi3FreeInstance(void *instance)
{
    free(instance);
}

EXPORTED int fmi3Reset(void *instance)
{
    memset(instance, 0, sizeof(unit_t));
    return OK;
}

EXPORTED int fmi3EnterInitializationMode(void *instance, bool has_tolerance, double tolerance, double start_s, bool has_stop, double stop_s)
{
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop_s;
    ((unit_t *)instance)->time_s = start_s;
    return OK;
}

EXPORTED int fmi3SetFloat64(void *instance, const uint32_t *references, size_t count, const double *values, size_t value_count)
{
    if (count != value_count)
        return ERROR;
    for (size_t i = 0; i < count; i++) {
        if (references[i] != SET_KPA || !(values[i] >= 0 && values[i] <= 1e6))
            return ERROR;
        ((unit_t *)instance)->set_pa = values[i] * 1e3;
    }
    return OK;
}

EXPORTED int fmi3GetFloat64(void *instance, const uint32_t *references, size_t count, double *values, size_t value_count)
{
    const unit_t *unit = (const unit_t *)instance;
    const double p_pa = valve_time_s > 0 || flow_per_s > 0 ? unit->arrived_pa : unit->set_pa;
    double all[ALL], markers[2 * UPPER_MARKERS + 1];
    NAME_tip_t tip;
    const int outside = NAME_tip(p_pa, &tip);
    if (count != value_count)
        return ERROR;
    NAME_markers(p_pa, markers);
    all[TIME] = unit->time_s;
    all[SET_KPA] = unit->set_pa / 1e3;
    all[ARRIVED_KPA] = p_pa / 1e3;
    all[TIP_X_MM] = tip.x_m * 1e3;
    all[TIP_Y_MM] = tip.y_m * 1e3;
    all[ANGLE_DEG] = tip.angle_rad * 57.29577951308232;
    for (int i = 0; i < 2 * UPPER_MARKERS; i++)
        all[FIRST_MARKER + i] = markers[i] * 1e3;
    for (size_t i = 0; i < count; i++) {
        if (references[i] >= ALL)
            return ERROR;
        values[i] = all[references[i]];
    }
    return outside ? WARNING : OK;
}

EXPORTED int fmi3DoStep(void *instance, double time_s, double step_s, bool no_return, bool *event, bool *terminate, bool *early,
                        double *last_s)
{
    (void)no_return;
    *event = *terminate = *early = false;
    *last_s = time_s;
    if (!(step_s > 0 && step_s < 1e6))
        return ERROR;
    pass((unit_t *)instance, step_s);
    ((unit_t *)instance)->time_s = *last_s = time_s + step_s;
    return OK;
}

/* Calls that change nothing here, and calls for what it has not. */
#define NOTHING(name) EXPORTED int fmi3##name(void) { return OK; }
#define REFUSED(name) EXPORTED int fmi3##name(void) { return ERROR; }
#define NO_VALUES(type) REFUSED(Get##type) REFUSED(Set##type)
NOTHING(SetDebugLogging) NOTHING(ExitInitializationMode) NOTHING(Terminate) NOTHING(EnterStepMode)
NO_VALUES(Float32) NO_VALUES(Int8) NO_VALUES(UInt8) NO_VALUES(Int16) NO_VALUES(UInt16) NO_VALUES(Int32) NO_VALUES(UInt32)
NO_VALUES(Int64) NO_VALUES(UInt64) NO_VALUES(Boolean) NO_VALUES(String) NO_VALUES(Binary) NO_VALUES(Clock) NO_VALUES(FMUState)
NO_VALUES(IntervalDecimal) NO_VALUES(IntervalFraction) NO_VALUES(ShiftDecimal) NO_VALUES(ShiftFraction)
REFUSED(EnterEventMode) REFUSED(GetNumberOfVariableDependencies) REFUSED(GetVariableDependencies) REFUSED(FreeFMUState)
REFUSED(SerializedFMUStateSize) REFUSED(SerializeFMUState) REFUSED(DeserializeFMUState) REFUSED(GetDirectionalDerivative)
REFUSED(GetAdjointDerivative) REFUSED(EnterConfigurationMode) REFUSED(ExitConfigurationMode) REFUSED(EvaluateDiscreteStates)
REFUSED(UpdateDiscreteStates) REFUSED(GetOutputDerivatives) REFUSED(ActivateModelPartition)
REFUSED(EnterContinuousTimeMode) REFUSED(CompletedIntegratorStep) REFUSED(SetTime) REFUSED(SetContinuousStates)
REFUSED(GetContinuousStateDerivatives) REFUSED(GetEventIndicators) REFUSED(GetContinuousStates)
REFUSED(GetNominalsOfContinuousStates) REFUSED(GetNumberOfEventIndicators) REFUSED(GetNumberOfContinuousStates)

EXPORTED void *fmi3InstantiateModelExchange(void)
{
    return NULL;
}

EXPORTED void *fmi3InstantiateScheduledExecution(void)
{
    return NULL;
}
