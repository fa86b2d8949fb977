"""What scripts/fuzz_urdf.py and a list of hostile files brought to light in the URDF reader; each stays fixed."""

import math
import os
import socket
import stat
from pathlib import Path

import pytest

from cga_codegen.robots import safe_xml
from cga_codegen.robots.errors import (
    BadNumberError,
    BrokenFileError,
    DuplicateNameError,
    InertiaWarning,
    TreeError,
    UnreadableFileError,
    UnsafeFileError,
    UnsupportedJointError,
)
from cga_codegen.robots.from_urdf import load_urdf

LIMIT = '<limit lower="-1" upper="1.5" velocity="3" effort="4"/>'
AB = '<link name="a"/><link name="b"/>'
ABC = AB + '<link name="c"/>'
LONG = "y" * 100_000


def urdf(body, name="r"):
    return f'<robot name="{name}">{body}</robot>'


def joint(name="j", parent="a", child="b", kind="revolute", inside=LIMIT):
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


def row(ratio, offset="0"):
    """Three joints in a row, each mimics the one before."""
    links = ABC + '<link name="d"/>'
    mimics = [f'<mimic joint="{leader}" multiplier="{ratio}" offset="{offset}"/>' + LIMIT for leader in "jk"]
    return urdf(links + joint() + joint("k", "b", "c", inside=mimics[0]) + joint("l", "c", "d", inside=mimics[1]))


def axis(text):
    return urdf(AB + joint(inside=f'<axis xyz="{text}"/>' + LIMIT))


REFUSED = {
    "multipliers that overflow together": (
        row("-1e49"),
        BadNumberError,
        "joint 'l' mimics 'j' by way of others with multiplier 1e+98 and offset 0; less than 1e+50 is needed",
    ),
    "offsets that overflow together": (row("1e30", "-1e30"), BadNumberError, "joint 'l' mimics 'j' by way of others with multiplier 1e+60"),
    "Arabic digits": (axis("0 0 \u0661"), BadNumberError, "joint 'j': axis is '0 0 \u0661'; 3 numbers are needed"),
    "fullwidth digits": (axis("0 0 \uff11"), BadNumberError, "joint 'j': axis is '0 0 \uff11'; 3 numbers are needed"),
    "a space that is none": (axis("0 0\u00a01"), BadNumberError, "joint 'j': axis is '0 0\\xa01'; 3 numbers are needed"),
    "a long link": (
        urdf(f'<link name="{LONG}"/>'),
        BrokenFileError,
        f"a <link> has a name of 100000 characters ('{'y' * 40}'...); at most 200 are read",
    ),
    "a long joint": (urdf(AB + joint(name=LONG)), BrokenFileError, "a <joint> has a name of 100000 characters ('"),
    "a long robot": (urdf(AB + joint(), LONG), BrokenFileError, "a <robot> has a name of 100000 characters ('"),
    "a long child": (urdf(AB + joint(child=LONG)), TreeError, f"joint 'j': its child link '{'y' * 80}' does not exist"),
    "a long type": (urdf(AB + joint(kind=LONG)), UnsupportedJointError, f"joint 'j' is of type '{'y' * 80}'; revolute, continuous"),
    "a long leader": (
        urdf(AB + joint(inside=f'<mimic joint="{LONG}"/>' + LIMIT)),
        UnsupportedJointError,
        f"joint 'j' mimics '{'y' * 80}', which is no moving joint",
    ),
    "a long attribute": (
        urdf(AB + joint(inside=f"<origin {LONG}=''/>" + LIMIT)),
        BrokenFileError,
        f"joint 'j': <origin> has '{'y' * 80}'; x",
    ),
    "a long root": (f"<{LONG}/>", BrokenFileError, f"the root element is <{'y' * 80}>; a URDF has <robot>"),
}


@pytest.mark.parametrize(("text", "error", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_what_is_wrong_is_named(text, error, message, capfd):
    with pytest.raises(error) as caught:
        load_urdf(text)
    said = str(caught.value)
    assert type(caught.value) is error
    assert said.startswith("URDF text: " + message) and said.isprintable() and len(said) < 300
    assert capfd.readouterr() == ("", "")


def test_what_only_just_fits_is_read():
    """Names of 200 characters, and multipliers that stay below 1e50 together."""
    name = "y" * 200
    assert load_urdf(urdf(AB + joint(name=name), name)).joints[0].name == name
    last = load_urdf(row("-2", "0.5")).joints[2]
    assert (last.follows, last.ratio) == ("j", 4.0)
    turn = last.placement.rotation[1][1]  # about x: -2 (-2 q + 0.5) + 0.5 = 4 q - 0.5
    assert math.isclose(turn, math.cos(-0.5), rel_tol=1e-15)


def test_a_joint_may_not_take_the_name_of_the_floating_base():
    """Two of that name made Pinocchio's model ambiguous; a link, or a joint that does not move, harms nobody."""
    text = urdf(AB + joint(name="root_joint"))
    assert load_urdf(text).joints[0].name == "root_joint"
    with pytest.raises(DuplicateNameError) as caught:
        load_urdf(text, base="floating")
    assert str(caught.value) == "URDF text: a joint is called 'root_joint', which is the floating base; another name is needed"
    fixed = load_urdf(urdf(AB + joint(name="root_joint", kind="fixed", inside='<origin xyz="1 2 3"/>')), base="floating")
    assert [j.name for j in fixed.joints] == ["root_joint"]
    assert fixed.frame("root_joint:joint").placement.translation == (1.0, 2.0, 3.0)
    assert [j.name for j in load_urdf(urdf('<link name="root_joint"/>'), base="floating").joints] == ["root_joint"]


def test_a_namespace_of_the_whole_file_is_no_obstacle():
    plain = urdf(AB + joint())
    assert load_urdf(plain.replace("<robot", "<robot xmlns='http://drake.mit.edu'")) == load_urdf(plain)
    assert load_urdf(plain.replace("<", "<q:").replace("<q:/", "</q:").replace("<q:robot", "<q:robot xmlns:q='urn:q'")) == load_urdf(plain)
    with pytest.raises(BrokenFileError, match="the root element is <link>; a URDF has <robot>"):
        load_urdf('<link name="a"/>')
    with pytest.raises(BrokenFileError, match="contains xacro macros"):
        load_urdf('<xacro:robot xmlns:xacro="http://www.ros.org/wiki/xacro"/>')


def test_an_inertia_of_no_body_is_named():
    """The triangle inequality: 1 + 1 < 3. The link is named, the numbers are used as given."""
    inside = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3"/></inertial>'
    with pytest.warns(InertiaWarning) as caught:
        model = load_urdf(urdf(f'<link name="a"/><link name="b">{inside}</link>' + joint()))
    (warning,) = caught
    needed = "no body has the principal moments 1, 1, 3 kg m^2 (none may exceed the sum of the others); used as given"
    assert str(warning.message) == f"URDF text: inertial of link 'b': {needed}"
    assert model.joints[0].inertia.tensor == (1.0, 0.0, 0.0, 1.0, 0.0, 3.0)


def test_meshes_are_neither_needed_nor_opened(tmp_path):
    """Missing files, packages that nobody knows, a pipe that would never end."""
    os.mkfifo(tmp_path / "pipe.stl")
    names = ("missing.stl", "package://nowhere/arm.dae", "file:///dev/zero", "http://127.0.0.1:9/a.stl", f"{tmp_path}/pipe.stl", "")
    shapes = [f'<{kind}><geometry><mesh filename="{name}"/></geometry></{kind}>' for name in names for kind in ("visual", "collision")]
    with_meshes = urdf(f'<link name="a">{"".join(shapes)}</link><link name="b"/>' + joint())
    assert load_urdf(with_meshes) == load_urdf(urdf(AB + joint()))


# ---- files


def refusal(given, error):
    with pytest.raises(error) as caught:
        load_urdf(given)
    return str(caught.value)


def test_what_is_no_file_is_refused_at_once(tmp_path):
    needed = "; a path to a URDF file is needed"
    listening = socket.socket(socket.AF_UNIX)
    listening.bind(str(tmp_path / "socket"))
    os.mkfifo(tmp_path / "pipe")
    os.symlink(tmp_path / "pipe", tmp_path / "link")
    for path in (tmp_path / "socket", tmp_path / "pipe", tmp_path / "link", Path("/dev/null"), Path("/dev/zero")):
        assert refusal(path, UnreadableFileError) == f"{path} is not a regular file{needed}"
    listening.close()
    os.symlink(tmp_path / "ring", tmp_path / "ring")
    assert refusal(tmp_path / "ring", UnreadableFileError).startswith(f"'{tmp_path}/ring' cannot be read (")
    with open(tmp_path / "sparse.urdf", "wb") as file:
        file.truncate(100_000_000)
    assert refusal(tmp_path / "sparse.urdf", UnsafeFileError) == f"{tmp_path}/sparse.urdf: 100000000 bytes given, at most 20000000 are read"


@pytest.mark.parametrize("given", [b"<robot/>", None, 3, ["a.urdf"]])
def test_what_is_neither_path_nor_text_is_refused(given):
    assert refusal(given, UnreadableFileError) == f"{given!r:.80} was given; a path to a URDF file is needed"


def test_a_pipe_put_in_place_of_a_file_is_not_waited_for(tmp_path, monkeypatch):
    """As some files of /proc, which say that they are regular and make their reader wait."""
    os.mkfifo(tmp_path / "pipe")
    pretend(monkeypatch, tmp_path)
    expected = f"'{tmp_path}/pipe' cannot be read (it is no file that can be read at once); a path to a URDF file is needed"
    assert refusal(tmp_path / "pipe", UnreadableFileError) == expected


def test_a_file_that_is_longer_than_it_says_is_not_read_to_its_end(tmp_path, monkeypatch):
    """As some files of /proc, which say that they are empty."""
    with open(tmp_path / "big.urdf", "wb") as file:
        file.truncate(50_000_000)
    pretend(monkeypatch, tmp_path)
    assert refusal(tmp_path / "big.urdf", UnsafeFileError) == f"{tmp_path}/big.urdf: 20000001 bytes given, at most 20000000 are read"


def pretend(monkeypatch, folder):
    """Whatever lies there says that it is an empty regular file."""
    (folder / "empty").write_bytes(b"")
    status = os.stat(folder / "empty")
    assert stat.S_ISREG(status.st_mode)
    monkeypatch.setattr(safe_xml.Path, "stat", lambda self, **_: status)


def test_names_of_files_are_shown_in_letters_that_can_be_printed(tmp_path):
    """A line break, and a byte that is no text: the name goes into messages and into what is generated."""
    for name, shown in (("a\nb.urdf", "a?b.urdf"), (os.fsdecode(b"\xff.urdf"), "?.urdf"), ("\u00e9.urdf", "\u00e9.urdf")):
        path = tmp_path / name
        path.write_text(urdf(AB + joint()), encoding="utf-8")
        assert load_urdf(path).source == shown
        path.write_text("<x/>", encoding="utf-8")
        assert refusal(path, BrokenFileError) == f"{shown}: the root element is <x>; a URDF has <robot>"
        path.write_bytes(b"\xff")
        assert refusal(path, UnreadableFileError).startswith(f"{tmp_path}/{shown}: not text in utf-8 (byte 0)")
