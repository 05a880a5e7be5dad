"""Problems of the Test Set for IVP Solvers as text, in the form of a case of the conformance benchmark.

F. Mazzia and C. Magherini, Test Set for Initial Value Problem Solvers, release 2.4, University of Bari and INdAM
(2008). Equations, numbers and reference end values are those of the test set, in its own units.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

RELATIVE = "largest relative error of a component at t_end"
FLOORED = (
    "largest error of the scored values at t_end, relative to max(|reference|, 1e-3 of the largest reference)"
)

Case = dict[str, Any]
Texts = Sequence[tuple[str, str]]


def case(
    name: str,
    parameters: Mapping[str, Any],
    y0: Mapping[str, Any],
    equations: Iterable[str],
    reference: Mapping[str, float],
    *,
    t_end: float,
    required: float,
    definitions: Texts = (),
    measure: str = RELATIVE,
    scored: Sequence[str] | None = None,
) -> Case:
    """Return what a case.json would hold."""
    return {
        "name": name,
        "format": "eqjson-1",
        "parameters": dict(parameters),
        "variables": list(y0),
        "definitions": [list(pair) for pair in definitions],
        "equations": list(equations),
        "y0": dict(y0),
        "t0": 0.0,
        "t_end": t_end,
        "reference": {"values": dict(reference)} | ({"scored": list(scored)} if scored else {}),
        "required": {"measure": measure, "value": required},
    }


def named(values: Sequence[float]) -> dict[str, float]:
    """Return values as y1, y2, ..."""
    return {f"y{k}": value for k, value in enumerate(values, start=1)}


def van_der_pol(mu: float = 1e3) -> Case:
    """Problem vdpolm: the stiff oscillator in slow time."""
    return case(
        "vdpolm",
        {"mu": mu},
        named([2.0, 0.0]),
        ["der(y1) - y2", "der(y2) - (mu*(1 - y1^2)*y2 - y1)"],
        named([1.706167732170469, -0.8928097010248125e-3]),
        t_end=2000.0,
        required=1e-7,
    )


def oregonator() -> Case:
    """Problem orego: the Belousov-Zhabotinskii reaction; its variables as an array."""
    return case(
        "orego",
        {"q": "8.375e-6", "s": "sqrt(s2)", "s2": 77.27**2, "w": 0.161},
        {"x[1]": 1, "x[2]": "2*x[1]", "x[3]": 3},
        [
            "der(x[1]) = s*(x[2] + x[1]*(1 - q*x[1] - x[2]))",
            "der(x[2]) = (x[3] - (1 + x[1])*x[2])/s",
            "der(x[3]) = w*(x[1] - x[3])",
        ],
        {"x[1]": 1.000814870318523, "x[2]": 1228.178521549917, "x[3]": 132.0554942846706},
        t_end=360.0,
        required=1e-7,
    )


def pollution() -> Case:
    """Problem pollu: 20 species of air pollution, 25 reactions; magnitudes from 4e-18 to 0.3."""
    k: tuple[float, ...] = (
        0.35,
        26.6,
        1.23e4,
        8.6e-4,
        8.2e-4,
        1.5e4,
        1.3e-4,
        2.4e4,
        1.65e4,
        9e3,
        0.022,
        1.2e4,
        1.88,
        1.63e4,
    )
    k += (4.8e6, 3.5e-4, 0.0175, 1e8, 4.44e11, 1240.0, 2.1, 5.78, 0.0474, 1780.0, 3.12)
    reactants = "1 2*4 5*2 7 7 7*6 9 9*6 11*2 11*1 13 10*2 14 1*6 3 4 4 16 16 17*6 19 19 1*4 19*1 20"
    rates = [
        (f"r{i}", f"k{i}*" + "*".join(f"y{j}" for j in who.split("*")))
        for i, who in enumerate(reactants.split(), 1)
    ]
    balances = (
        "-r1-r10-r14-r23-r24+r2+r3+r9+r11+r12+r22+r25 -r2-r3-r9-r12+r1+r21 -r15+r1+r17+r19+r22 "
        "-r2-r16-r17-r23+r15 -r3+2*r4+r6+r7+r13+r20 -r6-r8-r14-r20+r3+2*r18 -r4-r5-r6+r13 r4+r5+r6+r7 -r7-r8 "
        "-r12+r7+r9 -r9-r10+r8+r11 r9 -r11+r10 -r13+r12 r14 -r18-r19+r16 -r20 r20 -r21-r22-r24+r23+r25 -r25+r24"
    )
    end: tuple[float, ...] = (
        0.05646255480022769,
        0.1342484130422339,
        4.139734331099427e-09,
        0.005523140207484359,
    )
    end += (2.018977262302196e-07, 1.464541863493966e-07, 0.07784249118997964, 0.3245075353396018)
    end += (0.007494013383880406, 1.622293157301561e-08, 1.135863833257075e-08, 0.002230505975721359)
    end += (0.000208716288279863, 1.396921016840158e-05, 0.008964884856898295, 4.352846369330103e-18)
    end += (0.006899219696263405, 0.0001007803037365946, 1.772146513969984e-06, 5.682943292316392e-05)
    first = named([0.0] * 20) | {"y2": 0.2, "y4": 0.04, "y7": 0.1, "y8": 0.3, "y9": 0.01, "y17": 0.007}
    return case(
        "pollu",
        {f"k{i}": value for i, value in enumerate(k, 1)},
        first,
        [f"der(y{i}) - ({text})" for i, text in enumerate(balances.split(), 1)],
        named(end),
        t_end=60.0,
        required=1e-8,
        definitions=rates[::-1],
    )


def pleiades() -> Case:
    """Problem plei: seven stars in a plane, masses 1 to 7; near encounters make it sensitive."""
    stars = range(1, 8)
    first = {f"x{i}": v for i, v in zip(stars, (3, 3, -1, -3, 2, -2, 2), strict=True)}
    first |= {f"y{i}": v for i, v in zip(stars, (3, -3, 2, 0, 0, -4, 4), strict=True)}
    speeds = {f"{c}{i}": 0.0 for c in "uv" for i in stars} | {"u6": 1.75, "u7": -1.5, "v4": -1.25, "v5": 1.0}
    cubes = [
        (f"d{i}_{j}", f"((x{i} - x{j})**2 + (y{i} - y{j})**2)**1.5") for i in stars for j in stars if i < j
    ]

    def pull(c: str, i: int) -> str:
        return " + ".join(f"{j}*({c}{j} - {c}{i})/d{min(i, j)}_{max(i, j)}" for j in stars if j != i)

    equations = [f"der({c}{i}) = {s}{i}" for c, s in zip("xy", "uv", strict=True) for i in stars]
    equations += [f"der({s}{i}) = {pull(c, i)}" for c, s in zip("xy", "uv", strict=True) for i in stars]
    end: tuple[float, ...] = (
        0.3706139143970502,
        3.237284092057233,
        -3.222559032418324,
        0.659709145577531,
        0.3425581707156584,
    )
    end += (1.562172101400631, -0.7003092922212495, -3.943437585517392, -3.271380973972550, 5.225081843456543)
    end += (-2.590612434977470, 1.198213693392275, -0.2429682344935824, 1.091449240428980, 3.417003806314313)
    end += (1.354584501625501, -2.590065597810775, 2.025053734714242, -1.155815100160448, -0.8072988170223021)
    end += (0.595239635420871, -3.741244961234010, 0.377345968575063, 0.9386858869551073, 0.3667922227200571)
    end += (-0.347404635380849, 2.344915448180937, -1.947020434263292)
    return case(
        "plei",
        {},
        first | speeds,
        equations,
        dict(zip([*first, *speeds], end, strict=True)),
        t_end=3.0,
        required=1e-6,
        definitions=cubes,
        measure="largest error of positions and velocities at t_end, relative to max(|reference|, 1e-3)",
    )


PIPES: tuple[tuple[int, int], ...] = (
    (1, 2),
    (2, 3),
    (2, 6),
    (3, 4),
    (3, 5),
    (4, 5),
    (5, 10),
    (6, 5),
    (7, 4),
    (7, 8),
    (8, 5),
    (8, 10),
)
PIPES += ((9, 8), (11, 9), (11, 12), (12, 7), (12, 8), (13, 11))
NODES = (5, 8, 1, 2, 3, 4, 6, 7, 9, 10, 11, 12, 13)  # in the order of the test set; 5 and 8 store water


def water_tubes() -> Case:
    """Problem water: pipes that turn from laminar to turbulent, joined in nodes without storage; index 2.

    The test set prints the first flow with a digit missing (its flows into the second node would not sum up), so it
    is not scored.
    """
    names = [f"{i}_{j}" for i, j in PIPES]
    definitions = [
        ("a", "pi*d**2/4"),
        ("hour", "t/3600"),
        ("in1", "(1 - cos(exp(-hour) - 1))/200"),
        ("in13", "(1 - cos(exp(-hour) - 1))/80"),
        ("out10", "hour**2*(3*hour**2 - 92*hour + 720)/1e6"),
        *((f"Re{s}", f"abs(q{s}*d/(nu*a))") for s in names),
    ]
    equations = []
    for (i, j), s in zip(PIPES, names, strict=True):
        turbulent, laminar = f"f{s}*rho*L*q{s}**2/(a**2*d)", f"32*nu*rho*L*q{s}/(a*d**2)"
        equations.append(f"rho*L/a*der(q{s}) = p{i} - p{j} - ({turbulent} if Re{s} > Re_c else {laminar})")
    for s in names:
        wall = f"2*k/d + 18.7/(max(Re{s}, Re_c)*sqrt(f{s}))"
        equations.append(f"1/sqrt(f{s}) - 1.74 + 2*log10({wall})")
    for n in NODES:
        flows = [f"q{i}_{j}" for i, j in PIPES if j == n] + [f"-q{i}_{j}" for i, j in PIPES if i == n]
        flows += {1: ["in1"], 13: ["in13"], 10: ["-out10"]}.get(n, [])
        stored = f"b/(rho*g)*der(p{n})" if n in (5, 8) else "0"
        equations.append(f"{stored} = " + " + ".join(flows))
    q: tuple[float, ...] = (
        0.002298848296477430,
        0.001188984650746585,
        0.001109503645730845,
        0.0001589620100314825,
    )
    q += (0.001030022640715102, 0.0008710606306836165, 0.003243571480903489, 0.001109503645730845)
    q += (0.0007120986206521341, 0.0006414613963833099, 0.0009416978549524347, 0.003403428519096511)
    q += (0.002397639310739395, 0.002397639310739395, 0.003348581430454180, 0.001353560017035444)
    q += (0.001995021413418736, 0.005746220741193575)
    p: tuple[float, ...] = (
        111126.8591478108,
        111127.0045592387,
        111127.1078730254,
        111126.9851929858,
        111126.9255355337,
    )
    p += (111126.9322658045, 111126.9221703983, 111127.0121140691, 111127.4419515807, 111125.5158881087)
    p += (111127.8793439227, 111127.0995171642, 111129.8338971779)
    first: dict[str, float] = {f"q{s}": 0.0 for s in names} | {f"f{s}": 0.04751940452918529 for s in names}
    first |= {f"p{n}": 109800.0 for n in NODES}
    reference = {f"q{s}": v for s, v in zip(names, q, strict=True)}
    reference |= {f"p{n}": v for n, v in zip(NODES, p, strict=True)}
    return case(
        "water",
        {"nu": 1.31e-6, "g": 9.8, "rho": 1e3, "Re_c": 2.3e3, "L": 1e3, "k": 2e-4, "d": 1.0, "b": 2e2},
        first,
        equations,
        reference,
        t_end=17 * 3600.0,
        required=1e-6,
        definitions=definitions,
        scored=[n for n in reference if n != "q1_2"],
    )


def medical_akzo(cells: int) -> Case:
    """Problem medakzo with fewer cells: antibodies that penetrate a tissue; the supply ends at 5 min."""
    size = 1 / cells
    equations = []
    for j in range(1, cells + 1):
        z, left = j * size, f"u{j - 1}" if j > 1 else "phi"
        alpha, beta = 2 * (z - 1) ** 3 / 16, (z - 1) ** 4 / 16
        spread = f"{beta!r}*({left} - 2*u{j} + u{j + 1})/{size**2!r}"
        drift = f"{alpha!r}*(u{j + 1} - {left})/{2 * size!r}"
        move = f"{spread} + {drift} - " if j < cells else "-"
        equations += [f"der(u{j}) = {move}k*u{j}*v{j}", f"der(v{j}) = -k*u{j}*v{j}"]
    return case(
        "medakzo",
        {"k": 100.0},
        {f"{c}{j}": float(c == "v") for j in range(1, cells + 1) for c in "uv"},
        equations,
        {},
        t_end=20.0,
        required=1e-7,
        definitions=[("phi", "2 if t <= 5 else 0")],
        measure=FLOORED,
    )
