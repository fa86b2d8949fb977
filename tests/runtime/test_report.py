"""The report: its numbers, strict JSON, and a page that is whole by itself and safe to open."""

import json
import re
import stat
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from cga_codegen.robots.bundled import bundled_robots
from cga_runtime.errors import CgaError
from cga_runtime.report import nearest, strict_json
from cga_runtime.report.arms import line_through, meeting_point
from cga_runtime.report.build import SECTIONS, ReportFolderError, build_report
from cga_runtime.report.context import Context, ReportRobotError, Sizes
from cga_runtime.report.drawing import draw
from cga_runtime.report.mobility import normals, object_twists
from cga_runtime.report.still import still
from cga_runtime.robot import load_robot

SMALL = Sizes(samples=60, tries=2, poses=2, grid=9, rounds=1)
EVIL = "</script><img src=x onerror=alert(1)>\"'&{{7*7}}"
VOID = {"meta", "link", "input", "br", "img", "hr"}


class Page(HTMLParser):
    """Every element with its attributes, the text of scripts and styles, and the text of table cells, row by row."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.scripts: list[tuple[dict[str, str | None], str]] = []
        self.styles: list[str] = []
        self.words: list[str] = []
        self.rows: list[list[str]] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "script":
            self.scripts.append((dict(attrs), ""))
        elif tag == "style":
            self.styles.append("")
        elif tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-3:]}"
        self.open.pop()

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] == "script":
            self.scripts[-1] = (self.scripts[-1][0], self.scripts[-1][1] + data)
        elif self.open and self.open[-1] == "style":
            self.styles[-1] += data
        else:
            self.words.append(data)
            if {"td", "th"} & set(self.open):
                self.rows[-1][-1] += data

    def json(self, name: str) -> dict:
        return json.loads(next(text for attributes, text in self.scripts if attributes.get("id") == name))


def reject(constant: str) -> None:
    raise AssertionError(f"{constant} is not JSON")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report") / "new" / "folder"
    steps: list[tuple[int, int]] = []
    data = build_report("nao", folder, lambda done, total: steps.append((done, total)), SMALL)
    return folder, data, steps


@pytest.fixture(scope="module")
def page(made):
    return Page((made[0] / "index.html").read_text(encoding="utf-8"))


def urdf(tmp_path, *changes):
    """The bundled NAO with pieces of its text replaced."""
    text = Path(bundled_robots()["nao"]).read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (tmp_path / "changed.urdf").write_text(text, encoding="utf-8")
    return str(tmp_path / "changed.urdf")


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")


# ---- numbers


def test_json_is_strict_and_is_what_was_returned(made):
    folder, data, _ = made
    assert json.loads((folder / "report.json").read_text(encoding="utf-8"), parse_constant=reject) == data


def test_the_promised_keys_are_there(made):
    data = made[1]
    promised = {
        "mobility": {"joint_mobility", "object_dof", "motion_generic", "motion_parallel", "limb_ranks", "constraint_rank"},
        "limb": {"q2_star_right", "q2_star_inside_limits", "margin_rad", "factor_identity_error"},
        "constraint": {"object_dof", "joint_mobility", "reachable"},
        "schemes": {"total", "orbits", "admissible", "admissible_orbits", "never", "never_orbits", "singular_on_mirror", "best_median"}
        | {"best_p05", "table"},
        "reaching": {"point", "line", "plane", "sphere", "point_pair", "both_on_line", "rigid_grasp"},
        "nearest": {"limb", "constraint", "actuation"},
        "kernels": {"RHand/motor", "RHand/pose", "RHand+LHand/closure_error"},
    }
    assert data["robot"] == "nao" and data["seconds"] > 0 and {"cga-robotics", "numpy", "casadi", "python"} <= set(data["versions"])
    for section, keys in promised.items():
        assert keys <= set(data[section]), section
    assert list(promised) == [name for name, _, _ in SECTIONS]
    for entry in data["reaching"].values():
        assert {"solved", "tried", "iterations_median", "iterations_max", "seconds_median"} <= set(entry) and entry["tried"] == 2
    for entry in data["kernels"].values():
        assert entry["operations"] >= 0 and entry["nanoseconds"]["scalar"] > 0 and entry["nanoseconds"]["batch"] > 0 and entry["compiler"]


def test_mobility_and_motion(made):
    mobility = made[1]["mobility"]
    assert (mobility["joint_mobility"], mobility["object_dof"], mobility["limb_ranks"], mobility["constraint_rank"]) == (4, 4, [5, 5], 2)
    assert (mobility["motion_generic"], mobility["motion_parallel"]) == ("1T3R", "2T2R")
    assert mobility["poses_agreeing"] == mobility["poses_checked"] == 60
    assert mobility["generic"]["inside_limits"] and mobility["parallel"]["inside_limits"]
    assert mobility["generic"]["angle_between_forces"] > 0.5 and mobility["parallel"]["angle_between_forces"] < 1e-12


def test_limb_and_constraint_singularities_are_out_of_reach(made):
    limb, constraint = made[1]["limb"], made[1]["constraint"]
    assert limb["q2_star_right"] == pytest.approx(-np.arctan2(0.105, 0.015), abs=1e-14)
    assert limb["q2_star_left"] == pytest.approx(-limb["q2_star_right"], abs=1e-14)
    assert limb["margin_rad"] == pytest.approx(-1.32645 + np.arctan2(0.105, 0.015), abs=1e-12)
    assert not limb["q2_star_inside_limits"] and not limb["reachable"] and limb["factor_identity_error"] < 1e-12
    assert limb["f_in_limits"] == pytest.approx([0.010847, 0.106066], abs=1e-6)
    assert limb["sin_q4_in_limits"][0] == pytest.approx(np.sin(0.0349066), abs=1e-12)
    assert (constraint["object_dof"], constraint["joint_mobility"], constraint["limb_ranks"], constraint["reachable"]) == (
        3,
        5,
        [4, 4],
        False,
    )
    assert (constraint["force_rank"], constraint["wrench_rank"]) == (1, 3)


def test_atlas(made):
    schemes = made[1]["schemes"]
    counts = [schemes[key] for key in ("total", "orbits", "admissible", "admissible_orbits", "never", "never_orbits", "singular_on_mirror")]
    assert counts == [210, 110, 139, 71, 71, 39, 20]
    assert len(schemes["table"]) == 210 and schemes["samples"] == 60


def test_nearest_finds_none_inside_the_limits_where_none_is(made):
    parts = made[1]["nearest"]
    for kind in ("limb", "constraint"):
        assert parts[kind]["within_limits"]["found"] == 0 and parts[kind]["within_limits"]["median"] is None
        assert parts[kind]["unlimited"]["found"] == 2
    found = parts["actuation"]["unlimited"]
    assert found["minimum"] <= found["median"] <= found["maximum"] and found["distances"] == sorted(found["distances"])


def test_nao_v32_reaches_its_singularities(tmp_path):
    data = build_report("nao_v32", tmp_path, sizes=SMALL)
    assert data["limb"]["q2_star_right"] == pytest.approx(-np.pi / 2, abs=1e-14)
    assert data["limb"]["q2_star_inside_limits"] and data["limb"]["reachable"] and data["constraint"]["reachable"]
    assert (data["schemes"]["admissible"], data["schemes"]["admissible_orbits"]) == (135, 69)
    assert sum(not row["certified"] for row in data["schemes"]["table"]) == 4
    assert "4 schemes called never admissible" in (tmp_path / "index.html").read_text(encoding="utf-8")


def test_two_reports_differ_in_times_only(made, tmp_path):
    again = build_report("nao", tmp_path, sizes=SMALL)

    def timeless(value):
        if isinstance(value, dict):
            return {key: timeless(item) for key, item in value.items() if not re.match("seconds|nanoseconds", key)}
        return [timeless(item) for item in value] if isinstance(value, list) else value

    assert timeless(again) == timeless(made[1])


def test_progress_ends_at_its_total(made):
    steps = made[2]
    done = [step for step, _ in steps]
    assert done == sorted(done) and len({total for _, total in steps}) == 1 and steps[-1][0] == steps[-1][1]
    assert len(steps) == len(SECTIONS) + 1


# ---- geometry of the drawings


def test_object_twists_are_reciprocal_and_independent(nao, rng):
    context = Context(nao, SMALL)
    for q in context.loop.random(rng, 20):
        arms, found = context.arms(q), context.loop.mobility(q)
        forces = [wrench for arm in found.wrenches for wrench in arm]
        twists = object_twists(arms, np.array([wrench.f for wrench in forces]))
        assert [twist["kind"] for twist in twists].count("translation") == 1 and len(twists) == 4
        matrix = np.array([np.concatenate([twist["w"], twist["v"]]) for twist in twists])
        assert np.linalg.matrix_rank(matrix, tol=1e-9) == 4
        for wrench in forces:
            assert np.abs(matrix @ np.concatenate([wrench.m, wrench.f])).max() < 1e-12


def test_centres_lie_on_their_axes(nao, rng):
    context = Context(nao, SMALL)
    q = context.loop.random(rng)
    for arm, upper, chain, part in zip(
        (context.arms(q).right, context.arms(q).left), (0.105, 0.105), (context.loop.right, context.loop.left), (q[:5], q[5:]), strict=True
    ):
        for point, axes in ((arm.u, (0, 1)), (arm.s, (2, 3, 4)), (arm.elbow, (2,)), (arm.hand, ())):
            for j in axes:
                assert np.linalg.norm(np.cross(point - arm.anchors[j], arm.axes[j])) < 1e-12
        assert np.linalg.norm(arm.s - arm.u) == pytest.approx(np.hypot(0.105, 0.015), abs=1e-12)
        assert np.linalg.norm(arm.s - arm.elbow) == pytest.approx(upper, abs=1e-12)
        assert np.allclose(arm.hand, chain.pose(part)[:3, 3], atol=1e-12)


def test_meeting_point_of_two_lines():
    p, a, b = np.array([0.3, -0.2, 0.7]), np.array([1.0, 2.0, -1.0]), np.array([0.0, 1.0, 3.0])
    assert np.allclose(meeting_point(line_through(p + a, p - a), line_through(p - b, p + 2 * b)), p, atol=1e-14)


def test_normals_of_one_and_of_two_directions():
    f, g, across = np.array([0.6, 0.0, 0.8]), np.array([0.0, 1.0, 0.0]), np.array([0.0, 2.0, 0.0])
    assert np.allclose(np.abs(normals(np.array([f, g]), across)), [[0.8, 0.0, 0.6]])
    two = normals(np.array([f, -f]), across)
    assert np.allclose(np.abs(two), [[0.0, 1.0, 0.0], [0.8, 0.0, 0.6]]) and np.allclose(two @ f, 0.0)


# ---- the page


def test_page_loads_nothing_from_elsewhere(page, made):
    text = (made[0] / "index.html").read_text(encoding="utf-8")
    assert page.open == [] and text.startswith("<!DOCTYPE html>")
    for tag, attributes in page.elements:
        assert tag not in {"link", "img", "iframe", "object", "embed", "base", "form", "audio", "video", "source"}
        for key in ("src", "srcset", "data", "action", "poster", "background"):
            assert key not in attributes, (tag, attributes)
        assert attributes.get("href", "#").startswith("#") and attributes.get("xlink:href", "#").startswith("#")
        assert not any(key.startswith("on") for key in attributes)
    for style in page.styles:
        assert "@import" not in style and set(re.findall(r"url\(([^)]*)\)", style)) <= {"#head"}
    policy = next(a["content"] for tag, a in page.elements if tag == "meta" and a.get("http-equiv") == "Content-Security-Policy")
    assert policy is not None and "default-src 'none'" in policy and "http" not in policy and "eval" not in policy
    assert sum(text.startswith("/**\n* plotly.js") for _, text in page.scripts) == 1


def test_every_chart_has_a_figure_and_a_label(page):
    figures = page.json("figures")
    charts = [a for tag, a in page.elements if "data-figure" in a]
    assert {a["data-figure"] for a in charts} == set(figures) and len(charts) == len(figures)
    assert all(a.get("aria-label") for a in charts if "gl" not in (a["class"] or "").split())
    assert {"limb-0", "limb-1", "constraint-1", "pose-generic", "pose-parallel", "schemes-ranking", "nearest-unlimited"} <= set(figures)
    assert page.json("figure-theme")["layout"]["font"]["color"] == "var(--ink)"


def test_colours_are_variables_of_the_style_sheet_in_both_themes(page):
    light, dark = (re.search(pattern, page.styles[0], re.S).group(1) for pattern in (r":root \{(.*?)\}", r'data-theme="dark"\] \{(.*?)\}'))
    used = set(re.findall(r"var\((--\w+)\)", json.dumps([page.json("figures"), page.json("figure-theme")]) + page.styles[0]))
    assert used <= set(re.findall(r"(--\w+):", light)) and used <= set(re.findall(r"(--\w+):", dark))


def test_limb_map_is_the_closed_form(page):
    trace = page.json("figures")["limb-0"]["data"][0]
    q2, q4, z = (np.array(trace[key]) for key in "xyz")
    f = 0.105 * np.cos(q2) + 0.015 * np.sin(q2)
    assert z.shape == (9, 9) and np.allclose(z, 1e4 * np.hypot(0.105, 0.015) * np.abs(np.sin(q4)[:, None] * f), rtol=1e-3, atol=1e-3)


def test_slice_of_the_example_vanishes_on_its_diagonal(page):
    z = np.array(page.json("figures")["schemes-slice-example"]["data"][0]["z"])
    assert np.abs(np.diag(z)).max() < 1e-6 and np.array(page.json("figures")["schemes-slice-best"]["data"][0]["z"]).min() > 0.05


def test_table_of_schemes_has_210_rows_with_the_numbers_of_the_json(page, made):
    rows = [a for tag, a in page.elements if tag == "tr" and "data-joints" in a]
    table = made[1]["schemes"]["table"]
    assert [a["data-joints"] for a in rows] == [" ".join(map(str, row["actuated"])) for row in table]
    assert sum(a["data-orbit"] == "first" for a in rows) == 110 and sum(a["data-class"] == "never" for a in rows) == 71
    cells = {row[0]: row for row in page.rows if len(row) == 9}
    best = next(row for row in table if row["actuated"] == [1, 3, 7, 8])
    assert cells["1 3 7 8"][6] == f"{best['mu_median']:.3f}" and cells["2 3 4 5"][3].startswith("never")


def test_headline_numbers_are_read_on_the_page(page):
    words = " ".join(" ".join(page.words).split())
    for number in ("1T3R → 2T2R", "−1.4289 rad", "210 / 110", "139 / 71", "71 / 39", "0.1024 rad (5.87°) outside"):
        assert number in words, number


def test_names_from_the_robots_file_are_escaped(tmp_path):
    evil = escaped(EVIL)
    file = urdf(tmp_path, ('<robot name="nao"', f'<robot name="{evil}"'), ('"RElbowYaw"', f'"{evil} yaw"'))
    data = build_report(file, tmp_path / "out", sizes=SMALL)
    assert data["robot"] == EVIL
    page = Page((tmp_path / "out" / "index.html").read_text(encoding="utf-8"))
    assert not any(tag == "img" or "onerror" in attributes for tag, attributes in page.elements)
    assert any(EVIL in word for word in page.words) and "49" not in next(word for word in page.words if "onerror" in word)
    # plotly reads its few tags in texts: they must come as entities
    assert not re.search(r"<img", json.dumps(page.json("figures"))) and "&lt;img" in json.dumps(page.json("figures"))


def test_still_drawing_is_well_formed_and_escapes(nao, made):
    context = Context(nao, SMALL)
    pose = made[1]["mobility"]["generic"]
    drawing = draw(context.arms(np.array(pose["q"])), pose, [EVIL] * 10)
    root = ET.fromstring(still(drawing, EVIL))
    titles = [element.text for element in root.iter("title")]
    assert root.get("aria-label") == EVIL and titles.count(f"axis of {EVIL}") == 10
    assert sum("force" in (path.get("class") or "") for path in root.iter("path")) == 2


# ---- JSON


def test_plain_refuses_what_json_cannot_say():
    for value in (float("nan"), np.inf, [np.float64("nan")], {"a": -np.inf}):
        with pytest.raises(ValueError, match="cannot be written as JSON"):
            strict_json.plain(value)
    with pytest.raises(TypeError, match="set cannot be written"):
        strict_json.plain({1, 2})
    assert strict_json.plain({"a": np.float64(1.5), 2: (np.int64(3), np.bool_(True), None)}) == {"a": 1.5, "2": [3, True, None]}
    assert strict_json.plain(np.pi, 3) == 3.14


def test_json_in_a_script_cannot_end_it():
    text = strict_json.for_script({"a": "</script><!--&", "b": [1.23456789]}, 3)
    assert not set("<>&") & set(text) and json.loads(text) == {"a": "</script><!--&", "b": [1.23]}


# ---- refusals


def test_out_that_is_a_file_is_refused_before_work(tmp_path):
    (tmp_path / "file").write_text("")
    for out in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(ReportFolderError, match="--out") as caught:
            build_report("nao", out, sizes=SMALL)
        assert isinstance(caught.value, CgaError) and str(tmp_path / "file") in str(caught.value)


def test_out_that_cannot_be_written_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("os.access", lambda path, mode: False)
    with pytest.raises(ReportFolderError, match="cannot be written"):
        build_report("nao", tmp_path, sizes=SMALL)


def test_robots_of_another_kind_are_refused_with_what_is_needed(tmp_path):
    with pytest.raises(ReportRobotError, match="no frame RHand: the report needs two arms.*cga report nao"):
        build_report(urdf(tmp_path, ('"RHand"', '"RTool"')), tmp_path / "out", sizes=SMALL)
    text = Path(bundled_robots()["nao"]).read_text(encoding="utf-8")
    joint = re.search(r'<joint name="RWristYaw".*?</joint>', text, re.S).group(0)
    moved = re.sub(r'xyz="(\S+) (\S+) (\S+)"', r'xyz="\1 0.01 \3"', joint, count=1)
    assert moved != joint  # the last axis no longer meets the two before it
    with pytest.raises(ReportRobotError, match="no wrist centre"):
        build_report(urdf(tmp_path, (joint, moved)), tmp_path / "out", sizes=SMALL)
    assert list((tmp_path / "out").iterdir()) == []


def test_a_section_that_fails_fails_the_report(tmp_path, monkeypatch):
    def broken(context):
        raise RuntimeError("broken on purpose")

    monkeypatch.setattr(nearest, "section", broken)
    with pytest.raises(RuntimeError, match="broken on purpose"):
        build_report("nao", tmp_path, sizes=SMALL)
    assert list(tmp_path.iterdir()) == []


def test_report_replaces_an_older_one_and_may_be_read_by_others(made, tmp_path):
    (tmp_path / "report.json").write_text("old")
    (tmp_path / "kept.txt").write_text("not ours")
    build_report("nao", tmp_path, sizes=SMALL)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["index.html", "kept.txt", "report.json"]
    assert all(stat.S_IMODE((tmp_path / name).stat().st_mode) == 0o644 for name in ("index.html", "report.json"))
    assert json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))["robot"] == "nao"


def test_bundled_robot_is_loaded_as_everywhere(made):
    assert made[1]["mobility"]["generic"]["q"] and load_robot("nao").name == made[1]["robot"]
