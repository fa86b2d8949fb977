"""Mutated robot files for scripts/fuzz_urdf.py: whole files spoilt on purpose, in their elements, their text and their bytes.

A case is a function of (format, seed, index) alone. Each starts from a sound file (bundled robots, tests' data, the small ones below),
takes one to four mutations of the elements, then perhaps some of the text and of the bytes, and is given as a text or as a file.
"""

import random
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass

from robot_mutation_words import BODY, ENCODINGS, INSERTS, KINDS, LIMIT, NAMES, NUMBERS, PROLOGUES, SMALL, SPLICES, hinge, seeds


@dataclass(frozen=True)
class Case:
    """One robot file: what to give to the reader, whether as a file, and the names of the mutations that made it."""

    data: bytes
    as_file: bool
    base: str
    mimic: str
    made_by: tuple[str, ...]

    @property
    def text(self) -> str:
        """The bytes as a text; those that are none become lone surrogates."""
        return self.data.decode("utf-8", "surrogateescape")


# ---- mutations of elements: (random numbers, root) -> nothing


def _any(rng: random.Random, root: ET.Element) -> ET.Element:
    return rng.choice(list(root.iter()))


def _parent(rng: random.Random, root: ET.Element) -> ET.Element:
    return rng.choice([e for e in root.iter() if len(e)] or [root])


def _drop(rng: random.Random, root: ET.Element) -> None:
    parent = _parent(rng, root)
    if len(parent):
        parent.remove(rng.choice(list(parent)))


def _duplicate(rng: random.Random, root: ET.Element) -> None:
    parent = _parent(rng, root)
    if len(parent):
        parent.insert(rng.randrange(len(parent) + 1), ET.fromstring(ET.tostring(rng.choice(list(parent)))))


def _move(rng: random.Random, root: ET.Element) -> None:
    _any(rng, root).append(ET.fromstring(ET.tostring(_any(rng, root))))
    _drop(rng, root)


def _shuffle(rng: random.Random, root: ET.Element) -> None:
    parent = _parent(rng, root)
    parent[:] = rng.sample(list(parent), len(parent))


def _rename(rng: random.Random, root: ET.Element) -> None:
    tags = sorted({e.tag for e in root.iter()})
    _any(rng, root).tag = rng.choice([*tags, "x", "{urn:q}link", "Link", "t" * 5000])


def _attribute(rng: random.Random, root: ET.Element) -> None:
    element = _any(rng, root)
    if element.attrib:
        key = rng.choice(list(element.attrib))
        value = element.attrib.pop(key)
        if rng.random() < 0.4:
            element.set(rng.choice(["name", "xyz", "value", "x" * 3000, "{urn:q}name", key.upper()]), value)


def _swap(rng: random.Random, root: ET.Element) -> None:
    """Two values of one attribute change places, or one takes the other: links swap, joints share names, loops arise."""
    key = rng.choice(["link", "link", "joint", "name", "type", "xyz", "value", "axis", "class", "body"])
    having = [e for e in root.iter() if key in e.attrib]
    if having:
        one, other = rng.choice(having), rng.choice(having)
        values = one.attrib[key], other.attrib[key]
        one.attrib[key] = values[1]
        other.attrib[key] = rng.choice(values)


def _number(rng: random.Random, root: ET.Element) -> None:
    """One number of one attribute, or all of them."""
    having = [(e, key) for e in root.iter() for key, value in e.attrib.items() if value.strip()[:1] in set("+-.0123456789")]
    if having:
        key = rng.choice(sorted({key for _, key in having}))
        element = rng.choice([e for e, given in having if given == key])
        words = element.attrib[key].split()
        words[rng.randrange(len(words))] = rng.choice(NUMBERS)
        element.attrib[key] = rng.choice([" ".join(words), " ".join(words), rng.choice(NUMBERS)])


def _name(rng: random.Random, root: ET.Element) -> None:
    having = [(e, key) for e in root.iter() for key in ("name", "link", "joint") if key in e.attrib]
    if having:
        element, key = rng.choice(having)
        old, new = element.attrib[key], rng.choice(NAMES)
        everywhere = rng.random() < 0.7
        for other, kind in having if everywhere else [(element, key)]:
            if other.attrib[kind] == old:
                other.attrib[kind] = new


def _kind(rng: random.Random, root: ET.Element) -> None:
    rng.choice([e for e in root.iter() if "type" in e.attrib] or [root]).set("type", rng.choice(KINDS))


def _splice(rng: random.Random, root: ET.Element) -> None:
    target = rng.choice([e for e in root.iter() if e.tag in ("link", "joint", "robot", "body", "worldbody")] or [root])
    new = ET.fromstring(rng.choice(SPLICES))
    old = target.find(new.tag)
    if old is not None and new.tag not in ("link", "joint") and rng.random() < 0.8:
        target.remove(old)
    target.insert(rng.randrange(len(target) + 1), new)


def _graft(rng: random.Random, root: ET.Element) -> None:
    """Everything of another robot, renamed or not, hung on one of our links or left beside it."""
    form = "mjcf" if root.tag == "mujoco" else "urdf"
    other = ET.fromstring(rng.choice(seeds(form)))
    root.extend(list(other))


def _crowd(rng: random.Random, root: ET.Element) -> None:
    """Many links: in a row, as a star, as a tree, each with or without a body of its own; perhaps all mimicking."""
    count, shape = rng.choice([10, 100, 400, 1100]), rng.choice(["row", "star", "tree"])
    known = [e.get("name", "a") for e in root.iter("link")] or ["a"]
    follow = rng.choice(["", "", '<mimic joint="crowd0"/>', '<mimic joint="crowd{}" multiplier="1e30"/>'])
    kind, body = rng.choice(["fixed", "revolute", "prismatic", "continuous"]), rng.choice(["", BODY])
    for k in range(count):
        above = {"row": k - 1, "star": -1, "tree": k // 2 - (k < 2)}[shape]
        parent = f"crowd{above}" if above >= 0 else known[0]
        root.append(ET.fromstring(f'<link name="crowd{k}">{body}</link>'))
        inside = LIMIT + (follow.format(k - 1) if k else "")
        joint = ET.fromstring(hinge(f"crowd{k}", kind, "a", f"crowd{k}", inside))
        joint[0].set("link", parent)
        root.append(joint)


ELEMENTS: dict[str, Callable[[random.Random, ET.Element], None]] = {
    **{"drop": _drop, "duplicate": _duplicate, "move": _move, "shuffle": _shuffle, "rename": _rename, "attribute": _attribute},
    **{"swap": _swap, "number": _number, "name": _name, "kind": _kind, "splice": _splice, "graft": _graft, "crowd": _crowd},
}
WEIGHTS = {"number": 6, "swap": 3, "splice": 4, "kind": 2, "name": 2, "graft": 0.3, "crowd": 0.3}

# ---- mutations of the text, and of the bytes


def _at(rng: random.Random, text: str, words: tuple[str, ...]) -> str:
    place = rng.randrange(len(text) + 1)
    return text[:place] + rng.choice(words) + text[place:]


def _nest(rng: random.Random, text: str) -> str:
    """Elements within elements, as text: Python cannot write such a tree."""
    place = text.rfind("<", 0, rng.randrange(len(text)) + 1)
    depth, tag = rng.choice([5, 300, 3000, 100_000]), rng.choice(["x", "link", "body", "frame"])
    return text[:place] + f"<{tag}>" * depth + f"</{tag}>" * depth + text[place:] if place > 0 else text


TEXTS: dict[str, Callable[[random.Random, str], str]] = {
    "prologue": lambda rng, text: rng.choice(PROLOGUES) + text,
    "insert": lambda rng, text: _at(rng, text, INSERTS),
    "append": lambda rng, text: text + rng.choice(INSERTS + PROLOGUES),
    "nest": _nest,
    "namespace": lambda rng, text: text.replace(
        " name=", rng.choice([" xmlns='urn:q' name=", " xmlns:xacro='urn:xacro' name=", " xacro:name="]), 1
    ),
    "attribute twice": lambda rng, text: text.replace(" name=", " name='twice' name=", rng.randrange(1, 4)),
}


def _flip(rng: random.Random, data: bytearray) -> None:
    for _ in range(rng.choice([1, 1, 3, 30])):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)


def _slice(rng: random.Random, data: bytearray) -> tuple[int, int]:
    first = rng.randrange(len(data))
    return first, min(len(data), first + rng.choice([1, 2, 10, 200, 3000]))


def _delete(rng: random.Random, data: bytearray) -> None:
    first, last = _slice(rng, data)
    del data[first:last]


def _repeat(rng: random.Random, data: bytearray) -> None:
    first, last = _slice(rng, data)
    place = rng.randrange(len(data))
    data[place:place] = bytes(data[first:last]) * rng.choice([1, 1, 2, 100])


def _noise(rng: random.Random, data: bytearray) -> None:
    place = rng.randrange(len(data))
    data[place:place] = rng.randbytes(rng.choice([1, 2, 16]))


def _digit(rng: random.Random, data: bytearray) -> None:
    """A digit becomes another: still a robot, mostly."""
    places = [k for k, byte in enumerate(data) if 48 <= byte < 58]
    for place in rng.sample(places, min(len(places), rng.choice([1, 5, 50]))):
        data[place] = rng.choice(b"0123456789.-e")


def _truncate(rng: random.Random, data: bytearray) -> None:
    del data[rng.randrange(len(data)) :]


BYTES = {"flip": _flip, "delete": _delete, "repeat": _repeat, "noise": _noise, "digit": _digit, "truncate": _truncate}


def case(form: str, seed: int, index: int) -> Case:
    """Case `index` of a seed; the same on every machine."""
    rng = random.Random(f"{form} {seed} {index}")
    known = seeds(form)
    text, made_by = rng.choice(known[: len(SMALL[form])] if rng.random() < 0.5 else known), []
    level = rng.random()  # below 0.75: elements; above 0.6: text or bytes; between: both
    if level < 0.75:
        root = ET.fromstring(text)
        for name in rng.choices(list(ELEMENTS), [WEIGHTS.get(name, 1) for name in ELEMENTS], k=rng.choice([1, 1, 2, 4])):
            ELEMENTS[name](rng, root)
            made_by.append(name)
        text = ET.tostring(root, encoding="unicode")
    if level > 0.6 and rng.random() < 0.5:
        name = rng.choice(list(TEXTS))
        text = TEXTS[name](rng, text)
        made_by.append(name)
    encoding = rng.choice(ENCODINGS) if rng.random() < 0.03 else "utf-8"
    data = bytearray(text.encode(encoding, "surrogatepass" if encoding.startswith("utf") and encoding != "utf-7" else "replace"))
    if level > 0.6:
        for name in rng.choices(list(BYTES), k=rng.choice([0, 1, 1, 2])):
            if data:
                BYTES[name](rng, data)
                made_by.append(name)
    base = rng.choice(["fixed", "fixed", "floating"])
    return Case(
        bytes(data), encoding != "utf-8" or rng.random() < 0.4, base, rng.choice(["follow", "follow", "independent"]), tuple(made_by)
    )
