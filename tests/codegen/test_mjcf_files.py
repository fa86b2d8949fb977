"""Files that an MJCF includes or attaches: from its own folder only, each once, and not too many."""

import os

import pytest

from cga_codegen.robots.errors import BrokenFileError, TreeError, UnreadableFileError, UnsafeFileError
from cga_codegen.robots.from_mjcf import load_mjcf


def mjcf(inside):
    return f"<mujoco><worldbody>{inside}</worldbody></mujoco>"


def body(name):
    return f'<body name="{name}"><geom size="0.1"/></body>'


def write(folder, **files):
    for name, text in files.items():
        path = folder / f"{name}.xml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)


def test_files_come_only_from_the_folder(tmp_path):
    inside = tmp_path / "inside"
    write(tmp_path, secret=f"<any>{body('secret')}</any>")
    write(inside, part=f"<any>{body('part')}</any>", ring="<any><include file='ring.xml'/></any>", broken="<any>", link="")
    write(inside, child='<mujoco><asset><model name="c" file="child.xml"/></asset></mujoco>')
    (inside / "link.xml").unlink()
    (inside / "link.xml").symlink_to(tmp_path / "secret.xml")
    (inside / "self.xml").symlink_to(inside / "self.xml")
    os.mkfifo(inside / "pipe.xml")
    secret = str(tmp_path / "secret.xml")
    cases = {
        f'<include file="{secret}"/>': (UnsafeFileError, "a path relative to the file that names it is needed"),
        '<include file="C:\\a.xml"/>': (UnsafeFileError, "a path relative to the file that names it is needed"),
        '<include file="../secret.xml"/>': (UnsafeFileError, "'../secret.xml', which leads out of its folder; say with folder=..."),
        '<include file="part/..\\..\\secret.xml"/>': (UnsafeFileError, "which leads out of its folder"),
        '<include file="link.xml"/>': (UnsafeFileError, "'link.xml', which lies outside of folder 'inside'; files inside it are read"),
        '<include file="none.xml"/>': (UnreadableFileError, "<include> names file 'none.xml', which does not exist"),
        '<include file="self.xml"/>': (UnreadableFileError, "<include> names file 'self.xml', which cannot be found ("),
        f'<include file="{"a" * 300}.xml"/>': (UnreadableFileError, "which cannot be found ("),
        '<include file="."/>': (UnreadableFileError, "is a folder; a path to a MJCF file is needed"),
        '<include file="pipe.xml"/>': (UnreadableFileError, "is not a regular file"),
        '<include file="broken.xml"/>': (BrokenFileError, "broken.xml: not well-formed XML"),
        '<include file="part.xml"/><include file="part.xml"/>': (
            BrokenFileError,
            "'part.xml' is included twice; a file may be included once",
        ),
        '<include file="ring.xml"/>': (BrokenFileError, "'ring.xml' is included twice"),
    }
    for text, (error, message) in cases.items():
        write(inside, main=mjcf(text))
        with pytest.raises(error) as caught:
            load_mjcf(inside / "main.xml")
        assert type(caught.value) is error and message in str(caught.value), text
    with pytest.raises(TreeError, match="model file 'child.xml' attaches itself in the end"):
        load_mjcf(inside / "child.xml")
    with pytest.raises(UnreadableFileError, match="is no folder; the one with the files that it includes is needed"):
        load_mjcf(mjcf(""), folder=inside / "main.xml")
    write(inside, main=mjcf('<include file="../secret.xml"/>'))
    assert "secret" in [frame.name for frame in load_mjcf(inside / "main.xml", folder=tmp_path).frames]
    write(inside, main=mjcf('<include file="part.xml"/>'))
    assert [frame.name for frame in load_mjcf(inside / "main.xml").frames] == ["world", "part"]


def test_many_or_large_files_are_not_read(tmp_path):
    for k in range(101):
        write(tmp_path, **{f"f{k}": f'<any><frame/><include file="f{k + 1}.xml"/></any>'})
    with pytest.raises(UnsafeFileError, match="more than 100 files or 20000000 bytes are included; at most these are read"):
        load_mjcf(mjcf('<include file="f0.xml"/>'), folder=tmp_path)
    with open(tmp_path / "f0.xml", "wb") as file:
        file.truncate(20_000_001)
    with pytest.raises(UnsafeFileError, match="more than 100 files or 20000000 bytes"):
        load_mjcf(mjcf('<include file="f0.xml"/>'), folder=tmp_path)
