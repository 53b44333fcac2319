"""Charts on axes of matplotlib, in mm and kPa."""

from __future__ import annotations

import numpy as np


def _axes(axes):
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def _labelled(axes, x, y, title):
    axes.set(xlabel=x, ylabel=y, title=title)
    axes.spines[["top", "right"]].set_visible(False)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False)
    return axes


def _plane(axes, title):
    axes.set_aspect("equal", adjustable="datalim")
    return _labelled(axes, "x along the body [mm]", "y towards the actuator [mm]", title)


def state(state, axes=None):
    """Centre line and markers of a predicted state."""
    axes = _axes(axes)
    (line,) = axes.plot(*state.curve_mm.T, label=f"{state.pressure_kpa:g} kPa")
    axes.plot(*state.markers_mm.T, "o", color=line.get_color())
    return _plane(axes, "Predicted shape")


def comparison(found, axes=None):
    """Measured and predicted markers of every hold."""
    axes, table = _axes(axes), found.table
    first = table["model"] == found.names[0]
    holds = np.unique(np.stack([table["p_body_kpa"], table["p_act_kpa"]])[:, first], axis=1).T
    several = len(np.unique(holds[:, 0])) > 1
    for k, (body, pressure) in enumerate(holds):
        at = first & (table["p_body_kpa"] == body) & (table["p_act_kpa"] == pressure)
        name = f"{pressure:.0f} kPa" + (f", body {body:.0f}" if several else "")
        axes.plot(table["predicted_x_mm"][at], table["predicted_y_mm"][at], "_", ms=12, color=f"C{k % 10}")
        axes.plot(table["x_mm"][at], table["y_mm"][at], "o", ms=5, color=f"C{k % 10}", label=name)
    return _plane(axes, f"Measured (dots) and predicted (bars): {found.data}")


def diagnosis(found, axes=None):
    """Error that is left with every effect: blue where the data cannot tell them apart, pale where one sits on a bound."""
    axes, table = _axes(axes), found.table
    order = np.argsort(table["systematic_after_mm"], kind="stable")[:12][::-1]
    names = [name.replace("_", " ") for name in table["effect"][order]]
    colours = np.where(table["in_set"], "C0", np.where(table["at_bound"], "0.9", "0.7"))[order]
    axes.barh(names, table["systematic_after_mm"][order], color=colours)
    axes.axvline(found.base["systematic_mm"], color="C3", label="without any of them")
    return _labelled(axes, "error beyond noise [mm]", "", "What is left with each effect")


def run(run, axes=None):
    """Height of the tip at every hold."""
    axes, table = _axes(axes), run.table
    axes.plot(table["p_act_kpa"], table["tip_y_mm"], "o-")
    return _labelled(axes, "actuator pressure [kPa]", "height of the tip [mm]", run.name)
