"""The cases of this folder by the engine and by CalculiX, with closed forms where there are any.

    python3 compare.py table FOLDER     FOLDER/CASE has history.csv of the engine, deck.inp and deck.dat of CalculiX
    python3 compare.py cases            the names of the cases
    python3 compare.py nodes DECK...    places of the nodes in DECK.inp and in DECK.frd, as CalculiX read them

Ends with 1 where the two are more than 3 % apart, or a node is elsewhere. The standard library is enough.
"""

import csv
import math
import pathlib
import sys
import tomllib

HERE = pathlib.Path(__file__).parent
LIMIT = 0.03


def bisect(low, high, is_low):
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_low(middle) else (low, middle)
    return low


def film(case, name):
    """Stiffness along x of a sheet that keeps its width, N/m."""
    f = case["fabric"][name]
    e, nu = f.get("e90_MPa", f.get("e_MPa")), f.get("nu", f.get("nu12"))
    other = f["nu12"] * f["e90_MPa"] / f["e0_MPa"] if "nu12" in f else nu
    return 1e6 * e * 1e-3 * f["thickness_mm"] / (1 - nu * other)


def end(curve):
    return curve[-1][1]


def arc(a, pressure, length, half_angle):
    """Stretch of an arc of a sheet of stiffness a: a (λ² − 1) λ/2 = p λ L/(2θ)."""
    return math.sqrt(1 + pressure * length / (half_angle * a))


def disc(case):
    f, r = case["fabric"]["film"], 0.5 * case["mesh"]["diameter_mm"]
    p = 1e-3 * end(case["chamber"]["air"]["smooth_s_kPa"])
    return 0.6536 * r * (p * r / (f["e_MPa"] * f["thickness_mm"])) ** (1 / 3)


def strip(case):
    length, p = 1e-3 * case["mesh"]["length_mm"], 1e3 * end(case["chamber"]["air"]["smooth_s_kPa"])
    a = film(case, "cloth")
    angle = bisect(1e-3, 1.5, lambda t: arc(a, p, length, t) * math.sin(t) > t)
    return 1e3 * length / (2 * math.sin(angle)) * (1 - math.cos(angle))


def tube(case):
    f, force = case["fabric"]["film"], case["force"][0]["total_n"][2]
    r, length, et = 0.5 * case["mesh"]["diameter_mm"], case["mesh"]["length_mm"], f["e_MPa"] * f["thickness_mm"]
    return force * length**3 / (3 * et * math.pi * r**3) + 2 * force * length * (1 + f["nu"]) / (math.pi * r * et)


def braid(case):
    """Growth between the second rings of a closed tube of constant hoop and axial force, its warp at an angle to the axis; small strains."""
    f, mesh = case["fabric"]["cloth"], case["mesh"]
    s, c = (g(math.radians(mesh["warp_deg"])) for g in (math.sin, math.cos))
    p, r = 1e-3 * end(case["chamber"]["body"]["smooth_s_kPa"]), 0.5 * mesh["diameter_mm"]
    axial, hoop = 0.5 * p * r / f["thickness_mm"], p * r / f["thickness_mm"]
    along = axial * c * c + hoop * s * s
    across = axial * s * s + hoop * c * c
    shear = (hoop - axial) * s * c
    e1, e2 = (along - f["nu12"] * across) / f["e0_MPa"], across / f["e90_MPa"] - f["nu12"] * along / f["e0_MPa"]
    e12 = shear / f["g_MPa"]
    between = mesh["length_mm"] * (1 - 2 / mesh["elements_along"])
    return between * (e1 * c * c + e2 * s * s - e12 * s * c)


def pouch(case):
    length, width = 1e-3 * case["mesh"]["length_mm"], 1e-3 * case["mesh"]["width_mm"]
    p, force, a = 1e3 * end(case["chamber"]["air"]["smooth_s_kPa"]), case["force"][0]["total_n"][0], film(case, "film")
    pull = lambda t: p * arc(a, p, length, t) * length * width * math.cos(t) / t
    angle = bisect(0.1, 1.57, lambda t: pull(t) > force)
    return 1e3 * length * (arc(a, p, length, angle) * math.sin(angle) / angle - 1)


# Case, what is compared, node set (or one less another), axis, closed form.
ROWS = [
    ("disc", "clamped disc, height of the centre", "centre_top", 2, disc),
    ("strip", "inflated strip, warp across, height of the middle", "centre_top", 2, strip),
    ("tube", "tube under a tip force, way of the tip", "tip", 2, tube),
    ("braid", "tube on the bias, growth between two rings", "tip_2-base_2", 0, braid),
    ("pillow", "pillow, height of the centre", "centre_top", 2, None),
    ("pillow", "pillow, pull-in of the edge", "mid_edge", 0, None),
    ("pouch", "pouch under a pull, way of its end", "right", 0, pouch),
]


def engine(folder, probe, axis):
    rows = list(csv.DictReader((folder / "history.csv").open()))
    return float(rows[-1][f"{probe}_d{'xyz'[axis]}_mm"])


def calculix(folder, probe, axis):
    """Mean displacement of a set at the end, mm."""
    values, inside = [], False
    for line in (folder / "deck.dat").read_text().splitlines():
        cells = line.split()
        if cells[:1] == ["displacements"]:
            inside = f"set {probe.upper()} " in line
            values = [] if inside else values
        elif inside and len(cells) == 4:
            values.append(float(cells[1 + axis]))
    return 1e3 * sum(values) / len(values)


def table(folder):
    print("| problem | engine mm | CalculiX mm | apart % | closed form mm |\n|---|---|---|---|---|")
    is_near = True
    for case, what, probe, axis, form in ROWS:
        first, *less = probe.split("-")
        of = lambda read: read(folder / case, first, axis) - sum(read(folder / case, name, axis) for name in less)
        ours, theirs = of(engine), of(calculix)
        exact = f"{form(tomllib.loads((HERE / f'{case}.toml').read_text())):.4g}" if form else "–"
        apart = ours / theirs - 1
        is_near &= abs(apart) <= LIMIT
        print(f"| {what} | {ours:.4g} | {theirs:.4g} | {100 * apart:+.1f} | {exact} |")
    return 0 if is_near else 1


def nodes(decks):
    """Largest distance of a coordinate in the deck from the one that CalculiX read; its .frd has six digits."""
    is_near = True
    for deck in decks:
        written, inside = {}, False
        for line in open(f"{deck}.inp"):
            if line.startswith("*"):
                inside = line.split(",")[0].strip().upper() == "*NODE"
            elif inside:
                number, *place = line.split(",")
                written[int(number)] = [float(x) for x in place]
        read = {}
        for line in open(f"{deck}.frd"):
            if line.startswith(" -3"):
                break
            if line.startswith(" -1"):
                read[int(line[3:13])] = [float(line[13 + 12 * k : 25 + 12 * k]) for k in range(3)]
        size = max(abs(x) for place in written.values() for x in place)
        known = written.keys() & read.keys()
        off = max(abs(a - b) for number in known for a, b in zip(written[number], read[number]))
        is_near &= off <= 1e-5 * size and len(known) > 0.9 * len(written)
        print(f"{pathlib.Path(deck).name}: {len(known)} of {len(written)} nodes, at most {1e3 * off:.2g} mm apart")
    return 0 if is_near else 1


if __name__ == "__main__":
    if sys.argv[1] == "nodes":
        sys.exit(nodes(sys.argv[2:]))
    elif sys.argv[1] == "cases":
        print(*dict.fromkeys(row[0] for row in ROWS))
    else:
        sys.exit(table(pathlib.Path(sys.argv[2])))
