"""The door for every XML description: files that are missing, endless, huge, hidden in an encoding, or that declare entities."""

import os

import pytest

from cga_codegen.robots.errors import BrokenFileError, UnreadableFileError, UnsafeFileError
from cga_codegen.robots.safe_xml import read_xml

DOCTYPE = '<!-- a --> <!DOCTYPE robot [<!ENTITY a "b">]><robot name="&a;"/>'


def refusal(given, error):
    with pytest.raises(error) as caught:
        read_xml(given, "URDF")
    return str(caught.value)


def test_files_that_cannot_be_read(tmp_path):
    needed = "; a path to a URDF file is needed"
    assert refusal(tmp_path / "no.urdf", UnreadableFileError) == f"'{tmp_path}/no.urdf' cannot be read (No such file or directory){needed}"
    assert refusal(tmp_path, UnreadableFileError) == f"{tmp_path} is a folder{needed}"
    assert refusal("", UnreadableFileError) == f"an empty path was given{needed}"
    assert refusal("a\0b", UnreadableFileError).startswith("'a\\x00b' cannot be read (")
    assert refusal("name: robot\n" * 1000, UnreadableFileError).endswith(f"cannot be read (File name too long){needed}")
    os.mkfifo(tmp_path / "pipe")
    assert refusal(tmp_path / "pipe", UnreadableFileError) == f"{tmp_path}/pipe is not a regular file{needed}"
    (tmp_path / "binary.urdf").write_bytes(b"<robot name='\xff\xfe'/>")
    assert refusal(tmp_path / "binary.urdf", UnreadableFileError) == f"{tmp_path}/binary.urdf: not text in utf-8 (byte 13){needed}"
    (tmp_path / "zip.urdf").write_bytes(b"<?xml version='1.0' encoding='zip'?><robot/>")
    expected = f"{tmp_path}/zip.urdf: encoding 'zip' given; utf-8, utf-16, us-ascii or iso-8859-1 is needed"
    assert refusal(tmp_path / "zip.urdf", UnreadableFileError) == expected
    (tmp_path / "empty.urdf").write_bytes(b"")
    expected = "empty.urdf: not well-formed XML (no element found: line 1, column 0); a URDF is needed"
    assert refusal(tmp_path / "empty.urdf", BrokenFileError) == expected


def test_a_file_over_20_mb_is_not_read(tmp_path):
    with open(tmp_path / "big.urdf", "wb") as file:
        file.truncate(20_000_001)
    assert refusal(tmp_path / "big.urdf", UnsafeFileError) == f"{tmp_path}/big.urdf: 20000001 bytes given, at most 20000000 are read"
    with open(tmp_path / "border.urdf", "wb") as file:
        file.truncate(20_000_000)
    refusal(tmp_path / "border.urdf", BrokenFileError)  # read, and found to be no XML


def test_a_doctype_in_another_encoding_is_seen(tmp_path):
    (tmp_path / "hidden.urdf").write_bytes(DOCTYPE.encode("utf-16"))
    assert refusal(tmp_path / "hidden.urdf", UnsafeFileError).startswith("hidden.urdf: a document type declaration")


@pytest.mark.parametrize("before", ["", "\n", "<?xml version='1.0'?>", "<!-- > --><?a <b> ?>\n<!-- <c> -->", "\ufeff"])
def test_a_doctype_is_seen_wherever_it_may_stand(before):
    message = "URDF text: a document type declaration (DOCTYPE, entities) is given; remove it, a URDF needs none"
    assert refusal(before + "<!DOCTYPE robot><robot/>", UnsafeFileError) == message


def test_elsewhere_a_doctype_is_only_text():
    root, source = read_xml("<!-- <!DOCTYPE x> --><robot><![CDATA[<!DOCTYPE x>]]></robot>", "URDF")
    assert (root.tag, root.text, source) == ("robot", "<!DOCTYPE x>", "URDF text")
    refusal("<robot><!DOCTYPE x></robot>", BrokenFileError)
