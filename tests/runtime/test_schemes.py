"""The atlas of actuation schemes: classes, reasons, orbits and statistics against the reference table (paper C, 5.2.2)."""

import json
from functools import cache
from itertools import combinations
from pathlib import Path

import numpy as np

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.schemes import (
    REASON_BASE,
    REASON_FLOAT,
    REASON_MIRROR,
    REASON_POINTS,
    REASON_WRISTS,
    atlas,
    conditioning,
    summary,
)
from cga_runtime.loading import load_robot
from cga_runtime.spaces.loop_walk import walk

ORACLE = json.loads((Path(__file__).parents[1] / "data" / "nao.json").read_text())
ALL = list(combinations(range(1, 11), 4))
OFF_MIRROR = {tuple(scheme) for scheme in ORACLE["singular_on_q1_eq_q6"]}
COUNTS = ORACLE["singular"]["counts"]
ROBOT = load_robot("nao")
LOOP = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))


def exchanged(scheme):
    """The scheme with right and left exchanged: joint j is the mirror image of joint j + 5."""
    return tuple(sorted((j + 4) % 10 + 1 for j in scheme))


@cache
def table(name="nao", samples=3000):
    robot = load_robot(name)
    return tuple(atlas(ClosedChain(robot.chain("RHand"), robot.chain("LHand")), samples))


def test_classes_of_all_schemes():
    """71 never, 20 off the mirror poses, 119 on them too; orbits pair each scheme with its mirror image."""
    rows = table()
    assert [tuple(row["actuated"]) for row in rows] == ALL
    for row in rows:
        scheme = tuple(row["actuated"])
        assert tuple(row["orbit"]) == min(scheme, exchanged(scheme))
        if scheme == (1, 2, 6, 7):
            expected = ("never", REASON_WRISTS)
        elif not {1, 6} & set(scheme):
            expected = ("never", REASON_BASE.format(1, 6))
        elif scheme in OFF_MIRROR:
            expected = ("admissible_off_mirror", REASON_MIRROR)
        else:
            expected = ("admissible", "")
        assert (row["class"], row["reason"]) == expected
        assert row["certified"] and (row["witness"] is None) == (row["class"] == "never")


def test_rows_of_the_reference_table():
    """Class, reason, orbit row by row: the reference found them by floating ranks and other random points."""
    rows = {tuple(row["actuated"]): row for row in table()}
    thin = {tuple(row["actuated"]): row for row in table("nao_v32", 300)}
    reasons = {
        "both S-joints passive (common line AB)": REASON_WRISTS,
        "q1 and q6 both passive (collinear shoulder axes)": REASON_BASE.format(1, 6),
    }
    for reference in ORACLE["schemes"]:
        row = rows[tuple(reference["act"])]
        assert row["orbit"] == reference["orbit"]
        assert (row["class"] == "never") == reference["never"] == (reference["generic_rank"] < 6)
        assert (row["class"] == "admissible") == (reference["mirror_rank"] == 6)
        assert (thin[tuple(reference["act"])]["class"] == "never") == (reference["rank_V32"] < 6)
        if reference["never"]:
            assert [row["reason"]] == [reasons[text] for text in reference["reason"]]
            assert row["mu_median"] < 1e-14 and row["mu_below_001"] == 1


def test_statistics_of_the_reference_table():
    """Medians to 10 %. A 5 % quantile of 3000 draws is itself uncertain by 8 %: compared by how many draws lie below, to four sigma."""
    draws = 4000
    mu = conditioning(LOOP, LOOP.random(np.random.default_rng(20), draws), ALL)
    column = {scheme: mu[:, k] for k, scheme in enumerate(ALL)}
    never = {tuple(row["actuated"]) for row in table() if row["class"] == "never"}
    assert max(column[scheme].max() for scheme in never) < 1e-13
    assert min(column[scheme].max() for scheme in ALL if scheme not in never) > 0.01
    tails = []
    for reference in (row for row in ORACLE["schemes"] if not row["never"]):
        values = column[tuple(reference["act"])]
        assert abs(np.median(values) / reference["mu_med"] - 1) < 0.10
        for key, share in (("mu_med", 0.5), ("mu_p05", 0.05)):
            sigma = np.sqrt(share * (1 - share) * (1 / 3000 + 1 / draws))
            assert abs((values < reference[key]).mean() - share) < 4 * sigma
        tails.append(np.quantile(values, 0.05) / reference["mu_p05"] - 1)
    assert np.sqrt(np.mean(np.square(tails))) < 0.15
    assert abs(np.mean(tails)) < 0.05


def test_counts():
    found = summary(table())
    assert {key: found[key] for key in ("total", "orbits", "admissible", "admissible_orbits", "never", "never_orbits")} == {
        "total": COUNTS["schemes"],
        "orbits": COUNTS["orbits"],
        "admissible": COUNTS["admissible"],
        "admissible_orbits": COUNTS["admissible_orbits"],
        "never": COUNTS["never"],
        "never_orbits": COUNTS["never_orbits"],
    }
    assert (found["total"], found["orbits"], found["admissible"], found["admissible_orbits"]) == (210, 110, 139, 71)
    assert (found["never"], found["never_orbits"]) == (71, 39)
    assert (found["singular_on_mirror"], found["singular_on_mirror_orbits"]) == (COUNTS["singular_on_q1_eq_q6"], 10) == (20, 10)
    assert found["best_median"] == [1, 3, 7, 8] and found["best_p05"] == [1, 3, 9, 10]
    everywhere = [row for row in table() if row["class"] == "admissible"]
    assert (len(everywhere), len({tuple(row["orbit"]) for row in everywhere})) == (119, 61)
    assert sum(row["actuated"] == list(exchanged(row["actuated"])) for row in table()) == COUNTS["self_mirror"] == 10
    base = [row for row in table() if row["reason"].startswith("joints 1 and 6")]
    assert (len(base), len({tuple(row["orbit"]) for row in base})) == (COUNTS["never_q1q6"], 38) == (70, 38)
    good = [set(row["actuated"]) for row in table() if row["class"] != "never"]
    assert [sum(len(scheme & {1, 6}) == k for scheme in good) for k in (0, 1, 2)] == [0, 112, 27]


def test_v32():
    """Without elbow offset axis 3 runs through the shoulder centre: four more schemes are never admissible."""
    found = summary(table("nao_v32", 300))
    assert (found["admissible"], found["admissible_orbits"]) == (COUNTS["V32_admissible"], COUNTS["V32_admissible_orbits"]) == (135, 69)
    thick, thin = ({tuple(r["actuated"]) for r in rows if r["class"] == "never"} for rows in (table(), table("nao_v32", 300)))
    extra = {(1, 2, 9, 10), (1, 4, 5, 7), (2, 6, 9, 10), (4, 5, 6, 7)}
    assert thick < thin and thin - thick == extra
    for row in table("nao_v32", 300):
        if tuple(row["actuated"]) in extra:
            assert row["reason"] == REASON_POINTS and not row["certified"] and row["mu_median"] < 1e-13


def test_shoulders_that_are_not_collinear():
    """The left arm raised by 13 mm: 209 schemes of 109 orbits; only {1, 2, 6, 7} stays out, for its reason (erratum E5)."""
    up = np.eye(4)
    up[2, 3] = 0.013
    rows = atlas(ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand", placement=up)), 64)
    found = summary(rows)
    assert (found["admissible"], found["admissible_orbits"]) == (COUNTS["non_collinear_shoulders_admissible"], 109) == (209, 109)
    (never,) = [row for row in rows if row["class"] == "never"]
    assert (never["actuated"], never["reason"], never["certified"]) == ([1, 2, 6, 7], REASON_WRISTS, True)
    for reference in ORACLE["schemes"]:
        assert (reference["rank_noncollinear_shoulders"] < 6) == (reference["act"] == never["actuated"])


def test_a_description_that_is_not_rational():
    """The same robot turned by 0.3 rad: its decimals are no exact rotation, so the classes come from mu, and say so."""
    turned = np.eye(4)
    turned[:2, :2] = [[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]]
    loop = ClosedChain(ROBOT.chain("RHand", placement=turned), ROBOT.chain("LHand", placement=turned))
    calls = []
    rows = atlas(loop, 300, progress=lambda done, total: calls.append((done, total)))
    assert calls == [(256, 300), (300, 300)]
    assert {(row["reason"], row["certified"], row["witness"]) for row in rows} == {(REASON_FLOAT, False, None)}
    exact = {tuple(row["actuated"]): row["class"] == "never" for row in table()}
    assert {tuple(row["actuated"]): row["class"] == "never" for row in rows} == exact


def test_a_fixed_grasp_gives_the_same_classes():
    """340 configurations of the symmetric grasp: the largest mu of each scheme separates the same 139 from the same 71."""
    found = walk(LOOP, ORACLE["sampling"]["symmetric grasp"]["q0"], 400, np.random.default_rng(26))
    largest = conditioning(LOOP, found.q, ALL).max(axis=0)
    admissible = {tuple(row["actuated"]) for row in table() if row["class"] != "never"}
    assert {scheme for scheme, mu in zip(ALL, largest, strict=True) if mu > 1e-3} == admissible
    assert largest[largest < 1e-3].max() < 1e-13
    at_start = conditioning(LOOP, found.q[0], ALL)
    assert max(at_start[ALL.index(scheme)] for scheme in [*OFF_MIRROR, (1, 2, 6, 7)]) < 1e-15
