"""The report's page: whole by itself, safe to open, and showing the numbers of report.json; and the geometry of its drawings."""

import json
import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from cga_codegen.robots.bundled import bundled_robots
from cga_runtime.report.arms import line_through, meeting_point
from cga_runtime.report.build import build_report
from cga_runtime.report.context import Context, Sizes
from cga_runtime.report.cooperative import BIVECTORS
from cga_runtime.report.drawing import draw
from cga_runtime.report.mobility import normals, object_twists
from cga_runtime.report.still import still

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


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    return folder, build_report("nao", folder, sizes=SMALL)


@pytest.fixture(scope="module")
def page(made):
    return Page((made[0] / "index.html").read_text(encoding="utf-8"))


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")


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
        assert "@import" not in style and "url(" not in style
    policy = next(a["content"] for tag, a in page.elements if tag == "meta" and a.get("http-equiv") == "Content-Security-Policy")
    assert policy is not None and "default-src 'none'" in policy and "http" not in policy and "eval" not in policy
    assert sum(text.startswith("/**\n* plotly.js") for _, text in page.scripts) == 1


def test_every_chart_has_a_figure_and_a_label(page):
    figures = page.json("figures")
    charts = [a for tag, a in page.elements if "data-figure" in a]
    assert {a["data-figure"] for a in charts} == set(figures) and len(charts) == len(figures)
    assert all(a.get("aria-label") for a in charts if "gl" not in (a["class"] or "").split())
    assert {"limb-0", "limb-1", "constraint-1", "pose-generic", "pose-parallel", "schemes-ranking", "nearest-unlimited"} <= set(figures)
    assert {"pose-hands-pair", "pose-hands-line", "pose-hands-way", "cooperative-manipulability", "cooperative-weakest"} <= set(figures)
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
    assert any(row[:1] == ["actuation of " + " ".join(map(str, made[1]["schemes"]["best_median"]))] for row in page.rows)
    assert cells["1 3 7 8"][6] == f"{best['mu_median']:.3f}" and cells["2 3 4 5"][3].startswith("never")


def test_headline_numbers_are_read_on_the_page(page):
    words = " ".join(" ".join(page.words).split())
    for number in ("1T3R → 2T2R", "−1.4289 rad", "210 / 110", "139 / 71", "71 / 39", "0.1024 rad (5.87°) outside"):
        assert number in words, number


def test_the_hands_have_their_section_in_its_place(page, made):
    sections = [a["id"] for tag, a in page.elements if tag == "section"]
    links = [(a["href"] or "")[1:] for tag, a in page.elements if tag == "a" and (a.get("href") or "").startswith("#")]
    assert sections == [link for link in links if link in sections] and sections.index("cooperative") == sections.index("reaching") + 1
    cooperative = made[1]["cooperative"]
    words = " ".join(" ".join(page.words).split())
    for number in ("10, 6, 4", "10, 4, 6", "60 of 60", "2 / 2", f"{1e3 * cooperative['point_pair']['weakest']['median']:.1f}"):
        assert number in words, number
    rows = {row[0]: row[1:] for row in page.rows if row}
    for motion, words_of in zip(cooperative["nullspace"]["motions"][:2], ("right arm: hand slides", "left arm: hand slides"), strict=True):
        row = next(cells for name, cells in rows.items() if name.startswith(words_of))
        assert row[:2] == [f"{1e3 * speed:.1f} mm/s".replace("-0.0", "0.0") for speed in motion["along"]]
    assert [blade for blade in rows if blade in ("e12", "e13", "e23", "e0i", "e1i", "e2i", "e3i")] == list(BIVECTORS)
    assert rows["e13"][1:] == ["–", "–", "–"] and rows["e2i"][3] == "–" and rows["e2i"][2].endswith(" %")


def test_drawings_need_no_script_and_nothing_that_may_be_hidden(page):
    stills = [a for tag, a in page.elements if tag == "svg"]
    assert len(stills) == 5 and all("hidden" not in a and a["aria-label"] for a in stills)
    assert all("hidden" in a for _, a in page.elements if "gl" in (a.get("class") or "").split())
    assert not any(tag in ("use", "marker", "defs") for tag, _ in page.elements)  # what is referred to vanishes with the drawing it is in
    assert sum(a.get("class") == "head" for tag, a in page.elements if tag == "path") == 4 + 1 + 2  # slides; translations of both poses


def test_names_from_the_robots_file_are_escaped(tmp_path):
    evil = escaped(EVIL)
    text = Path(bundled_robots()["nao"]).read_text(encoding="utf-8")
    assert '<robot name="nao"' in text and '"RElbowYaw"' in text
    text = text.replace('<robot name="nao"', f'<robot name="{evil}"').replace('"RElbowYaw"', f'"{evil} yaw"')
    (tmp_path / "evil.urdf").write_text(text, encoding="utf-8")
    data = build_report(str(tmp_path / "evil.urdf"), tmp_path / "out", sizes=SMALL)
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


# ---- geometry of the drawings


def test_object_twists_are_reciprocal_and_independent(nao, rng):
    context = Context(nao, SMALL)
    for q in context.loop.random(rng, 20):
        arms, found = context.arms(q), context.loop.mobility(q)
        forces = [wrench for arm in found.wrenches for wrench in arm]
        twists = object_twists(arms, np.array([wrench.f for wrench in forces]))
        assert [twist["kind"] for twist in twists].count("translation") == 1 and len(twists) == 4
        ends = {"shoulder line U_R U_L": [arms.right.u, arms.left.u], "line S_R S_L of the S centres": [arms.right.s, arms.left.s]}
        ends["line S_R U_L"] = [arms.right.s, arms.left.u]
        assert {twist["name"]: np.array(twist["points"]).tolist() for twist in twists[1:]} == {
            k: np.array(v).tolist() for k, v in ends.items()
        }
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
        screws = chain.screws(part)  # e12 e13 e23 e1i e2i e3i: axis (e23, -e13, e12), velocity of the origin (e1i, e2i, e3i)
        for point, joints in ((arm.u, (0, 1)), (arm.s, (2, 3, 4)), (arm.elbow, (2,)), (arm.wrist, (4,))):
            for j in joints:
                assert np.allclose(arm.axes[j], [screws[2, j], -screws[1, j], screws[0, j]], atol=1e-12)
                assert np.allclose(np.cross(point, arm.axes[j]), screws[3:, j], atol=1e-12)
                assert np.allclose(np.cross(arm.anchors[j] - point, arm.axes[j]), 0.0, atol=1e-12)
        assert np.linalg.norm(arm.s - arm.u) == pytest.approx(np.hypot(0.105, 0.015), abs=1e-12)
        assert np.linalg.norm(arm.s - arm.elbow) == pytest.approx(upper, abs=1e-12)
        assert np.allclose(arm.hand, chain.pose(part)[:3, 3], atol=1e-12)
        assert np.linalg.norm(arm.hand - arm.wrist) == pytest.approx(0.01231, abs=1e-12)


def test_meeting_point_of_two_lines():
    p, a, b = np.array([0.3, -0.2, 0.7]), np.array([1.0, 2.0, -1.0]), np.array([0.0, 1.0, 3.0])
    assert np.allclose(meeting_point(line_through(p + a, p - a), line_through(p - b, p + 2 * b)), p, atol=1e-14)


def test_normals_of_one_and_of_two_directions():
    f, g, across = np.array([0.6, 0.0, 0.8]), np.array([0.0, 1.0, 0.0]), np.array([0.0, 2.0, 0.0])
    assert np.allclose(np.abs(normals(np.array([f, g]), across)), [[0.8, 0.0, 0.6]])
    two = normals(np.array([f, -f]), across)
    assert np.allclose(np.abs(two), [[0.0, 1.0, 0.0], [0.8, 0.0, 0.6]]) and np.allclose(two @ f, 0.0)
