"""What Python costs: its calls next to the library's own on the same pressures, in one run on one core.

    python python/bench.py

`ibr bench`, in the package itself, times the library. Where soromox is installed, its planar constant-curvature segment is timed
too, on jax and all cores: tip and six markers of one bend a call, jitted, and of many, vmapped. It is told the bend and solves no
balance, so its figures say what a call costs there; they compare no models.
"""

import json
import statistics
import subprocess
import sys
import time

# Beside this file lie the sources of the package, without its native part.
sys.path.pop(0)

import ibr  # noqa: E402
import numpy as np  # noqa: E402

# The library times batches of 10 000 states; a million no longer fit into the cache.
CALLS, BATCH, STATES, ROUNDS = 2000, 10_000, 1_000_000, 15


def of_the_library():
    """Microseconds per prediction and per state of a batch, of the ePAM as it ships."""
    typed = [sys.executable, "-m", "ibr", "bench", "--json", "--quiet"]
    found = json.loads(subprocess.run(typed, capture_output=True, text=True).stdout)["figures"]
    times = {figure["id"]: figure["shipped_us"] for figure in found}
    return times["predict/epam"], times["batch of 10 000, each/epam"]


def median_us(work, each):
    """Median microseconds of `work` over `each`."""
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        times.append((time.perf_counter() - start) * 1e6 / each)
    return statistics.median(times)


def of_python():
    robot = ibr.Scenario.named("epam")
    kpa = [10 + 20 * i / CALLS for i in range(CALLS)]

    def batch(count):
        # The order without pattern of the library's own bench.
        many = 10 + 20 * (np.arange(count) * 7919 % count) / count
        return median_us(lambda: robot.batch(many, threads=1), count)

    def single():
        for p in kpa:
            robot.predict(p)

    def changed():
        for p in kpa:
            robot.replace(body_radius_mm=40 + p / 10).predict(p)

    def labelled():
        many = 10 + 20 * (np.arange(STATES) * 7919 % STATES) / STATES
        return median_us(lambda: robot.batch(many, threads=1).to_pandas(), STATES)

    return median_us(single, CALLS), batch(BATCH), batch(STATES), labelled(), median_us(changed, CALLS)


def of_soromox():
    """Microseconds per call and per state of soromox, or why not."""
    try:
        import jax
        import jax.numpy as jnp
        import soromox  # noqa: F401
    except ImportError as cause:
        return f"not measured: {cause}"
    from soromox.systems.components import LinkSpec
    from soromox.systems.pcs import PlanarPCS, PlanarPCSStructure

    jax.config.update("jax_enable_x64", True)
    body = {"length": 0.36, "radius": 0.04, "density": 100.0, "reference_strain": [0.0, 1.0, 0.0]}
    link = LinkSpec.circular(**body, young_modulus=1e5, poisson_ratio=0.4)
    bends_only = PlanarPCSStructure(strain_selector=jnp.array([True, False, False]))
    robot = PlanarPCS.from_links([link], structure=bends_only)
    places = jnp.linspace(0.03, 0.36, 7)

    def poses(bend):
        return robot.forward_kinematics_abscissa_batched(bend[None], places)

    one, many = jax.jit(poses), jax.jit(jax.vmap(poses))
    bends = jnp.linspace(0.1, 4, STATES)
    few = list(bends[:CALLS])
    one(few[0]).block_until_ready()
    many(bends).block_until_ready()
    single = median_us(lambda: [one(bend).block_until_ready() for bend in few], CALLS)
    return single, median_us(lambda: many(bends).block_until_ready(), STATES)


def main():
    library, python = of_the_library(), of_python()
    print(f"{'':24}{'library µs':>12}{'Python µs':>12}{'ratio':>8}")
    names = ("one prediction", f"each of {BATCH} states", f"each of {STATES} states", "the same as a table")
    for name, one, other in zip(names, (*library, library[1], library[1]), python):
        print(f"{name:24}{one:12.3f}{other:12.3f}{other / one:8.2f}")
    target = 3 * library[0] + 0.3
    print(f"one prediction: target 3 times and 0.3 µs, {target:.2f} µs: {'met' if python[0] <= target else 'missed'}")
    print(f"table of {STATES}: target 1.3 times: {'met' if python[3] <= 1.3 * library[1] else 'missed'}")
    print(f"replace and predict: {python[4]:.2f} µs, target 5: {'met' if python[4] <= 5 else 'missed'}")
    others = of_soromox()
    if isinstance(others, str):
        print(f"soromox: {others}")
        return
    for name, mine, other in zip(("one call", f"each of {STATES}"), (python[0], python[2]), others):
        print(f"soromox, {name}: {other:.3f} µs, {other / mine:.1f} times that of ibr")


if __name__ == "__main__":
    main()
