"""Charts on axes of matplotlib, in mm and kPa."""

from __future__ import annotations

from typing import Any

import numpy as np


def _axes(axes: Any) -> Any:
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def _labelled(axes: Any, x: Any, y: Any, title: Any) -> Any:
    axes.set(xlabel=x, ylabel=y, title=title)
    axes.spines[["top", "right"]].set_visible(False)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False)
    return axes


def _plane(axes: Any, title: Any) -> Any:
    axes.set_aspect("equal", adjustable="datalim")
    return _labelled(axes, "x along the body [mm]", "y towards the actuator [mm]", title)


def _two(axes: Any) -> Any:
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt

    return plt.subplots(2, layout="constrained")[1]


def _sides(axes: Any, draw: Any, title: Any) -> Any:
    """The same on two axes: seen along z, then along y."""
    for side, (one, label) in enumerate(zip(axes, ("y, azimuth 0° [mm]", "z, azimuth 90° [mm]")), 1):
        draw(one, side)
        one.set_aspect("equal", adjustable="datalim")
        _labelled(one, "x along the body [mm]", label, title if side == 1 else "")
    return axes


def state(state: Any, axes: Any = None) -> Any:
    """Centre line and markers of a predicted state; of a robot with strips round the body from two sides, on two axes."""
    if state.tip_mm.size == 3:
        return _state_in_space(state, _two(axes))
    axes = _axes(axes)
    (line,) = axes.plot(*state.curve_mm.T, label=f"{state.pressure_kpa:g} kPa")
    axes.plot(*state.markers_mm.T, "o", color=line.get_color())
    return _plane(axes, "Predicted shape")


def _state_in_space(state: Any, axes: Any) -> Any:
    channels = "/".join(f"{kpa:g}" for kpa in np.trim_zeros(state.channels_kpa, "b"))
    # Equal pressures are one.
    name = f"{state.pressure_kpa:g} kPa" if np.ptp(state.channels_kpa) == 0 else f"{channels} kPa"

    def draw(one: Any, side: int) -> None:
        (line,) = one.plot(state.curve_mm[:, 0], state.curve_mm[:, side], label=name)
        one.plot(state.markers_mm[:, 0], state.markers_mm[:, side], "o", color=line.get_color())

    return _sides(axes, draw, "Predicted shape")


def comparison(found: Any, axes: Any = None) -> Any:
    """Measured and predicted markers of every hold; with z from two sides, on two axes."""
    table = found.table
    first = table["model"] == found.names[0]
    channels = [name for name in table if name.startswith("p_act_")]
    pressures = np.stack([table[name] for name in ["p_body_kpa", *channels]], axis=1)
    holds = np.unique(pressures[first], axis=0)
    several = len(np.unique(holds[:, 0])) > 1

    def draw(one: Any, side: int) -> None:
        axis = "xyz"[side]
        for k, hold in enumerate(holds):
            at = first & (pressures == hold).all(axis=1)
            name = "/".join(f"{kpa:.0f}" for kpa in hold[1:]) + " kPa" + (f", body {hold[0]:.0f}" if several else "")
            one.plot(table["predicted_x_mm"][at], table[f"predicted_{axis}_mm"][at], "_", ms=12, color=f"C{k % 10}")
            one.plot(table["x_mm"][at], table[f"{axis}_mm"][at], "o", ms=5, color=f"C{k % 10}", label=name)

    title = f"Measured (dots) and predicted (bars): {found.data}"
    if "z_mm" in table:
        return _sides(_two(axes), draw, title)
    axes = _axes(axes)
    draw(axes, 1)
    return _plane(axes, title)


def diagnosis(found: Any, axes: Any = None) -> Any:
    """Error that is left with every effect: blue where the data cannot tell them apart, pale where one sits on a bound."""
    axes, table = _axes(axes), found.table
    order = np.argsort(table["systematic_after_mm"], kind="stable")[:12][::-1]
    names = [name.replace("_", " ") for name in table["effect"][order]]
    colours = np.where(table["in_set"], "C0", np.where(table["at_bound"], "0.9", "0.7"))[order]
    axes.barh(names, table["systematic_after_mm"][order], color=colours)
    axes.axvline(found.base["systematic_mm"], color="C3", label="without any of them")
    return _labelled(axes, "error beyond noise [mm]", "", "What is left with each effect")


def run(run: Any, axes: Any = None) -> Any:
    """Height of the tip at every hold."""
    axes, table = _axes(axes), run.table
    axes.plot(table["pressure_kpa"], table["tip_y_mm"], "o-")
    return _labelled(axes, "actuator pressure [kPa]", "height of the tip [mm]", run.name)
