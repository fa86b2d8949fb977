"""Opens generated kernels: finds the folder, checks digests, and gives each kernel three views: numpy, batch, casadi.Function.

The numpy view runs compiled C where there is a compiler, else the same kernel's Python text; the casadi view evaluates that
text on symbols, so that its derivatives of any order are exact.
"""

from __future__ import annotations

import ctypes
import json
import math
from collections.abc import Callable, Sequence
from functools import cache, cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.cache import digest
from cga_runtime.compile import compile_library
from cga_runtime.errors import DegenerateError, NotFiniteError, StaleKernelError, UnknownNameError, WrongSizeError
from cga_runtime.layout import OF_Q, Layout

FORMAT = 2
Array = NDArray[np.float64]
_F64 = np.dtype(np.float64)


def generated_folder() -> Path:
    """The folder of kernels that came with the package: `_generated` in a wheel, `generated` in a checkout."""
    here = Path(__file__).parent
    for folder in (here / "_generated", here.parent / "generated"):
        if (folder / "manifest.json").is_file():
            return folder
    raise StaleKernelError(f"no generated kernels beside {here}: reinstall cga-robotics, or run `./run generate` in a checkout")


def numeric(values: ArrayLike, what: str) -> Array:
    """A float64 array; WrongSizeError if it is not numeric (text that looks like numbers and complex numbers are not)."""
    try:
        array = np.asarray(values)
        if array.dtype.kind in "biufO":
            return np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError, OverflowError, NotImplementedError) as error:
        raise WrongSizeError(f"{what}: not an array of numbers ({error})") from None
    raise WrongSizeError(f"{what}: not an array of numbers ({array.dtype} given)")


def finite(values: ArrayLike, what: str) -> Array:
    """A float64 array; WrongSizeError if it is not numeric, NotFiniteError if it holds NaN or infinity."""
    array = numeric(values, what)
    if not np.isfinite(array).all():
        first = tuple(int(k) for k in np.argwhere(~np.isfinite(array))[0])
        raise NotFiniteError(f"{what} holds NaN or infinity: {array[first]} at index {first} of shape {array.shape}")
    return array


class Library:
    """A generated folder: its manifest, and its files once their digests are checked."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        listing = folder / "manifest.json"
        try:
            self.manifest: dict[str, Any] = json.loads(listing.read_text(encoding="utf-8"))
            parts = [self.manifest.get(key) for key in ("files", "units", "robots")] if isinstance(self.manifest, dict) else [None]
            if not all(isinstance(part, dict) for part in parts) or "format" not in self.manifest:
                raise ValueError("unfinished, or a file of something else")
            if self.manifest["format"] != FORMAT:
                raise ValueError(f"its format is {self.manifest['format']}, this version reads {FORMAT}")
        except OSError as error:
            raise StaleKernelError(f"cannot read {listing}: {error.strerror}; {self._remedy()}") from None
        except ValueError as error:
            raise StaleKernelError(f"{listing} is not a manifest of generated kernels ({error}); {self._remedy()}") from None

    def _remedy(self) -> str:
        here = Path(__file__).resolve().parent
        carried = {here.parent / "generated": "run `./run generate`", here / "_generated": "reinstall cga-robotics"}
        return carried.get(self.folder.resolve(), f"run `cga generate FILE -o {self.folder}`")

    def read(self, path: str) -> str:
        """A file's text. StaleKernelError if it is missing or does not match its digest."""
        file = self.folder / path
        try:
            content = file.read_bytes()
        except OSError as error:
            raise StaleKernelError(f"cannot read {file}: {error.strerror}; {self._remedy()}") from None
        if digest(content) != self.manifest["files"].get(path):
            raise StaleKernelError(f"{file} was edited by hand or is stale: it does not match manifest.json; {self._remedy()}")
        return content.decode()

    @cache  # noqa: B019  a library lives as long as the process
    def unit(self, path: str) -> Unit:
        """What was generated together under that path."""
        return Unit(self, path)

    def __reduce__(self) -> tuple[Any, ...]:
        return library, (self.folder,)


def library(folder: Path) -> Library:
    """The library of a folder, read once and again whenever its manifest was written anew."""
    listing = folder.resolve() / "manifest.json"
    try:
        status = listing.stat()
    except OSError:
        return Library(listing.parent)  # says what is wrong
    return _library(listing.parent, (status.st_mtime_ns, status.st_size, status.st_ino))


@cache
def _library(folder: Path, written: tuple[int, ...]) -> Library:
    return Library(folder)


@cache
def products() -> SimpleNamespace:
    """The generated products of the algebra by name (`motor_motor(a, b)`, ...): component axis first, any scalar, results are tuples."""
    home = library(generated_folder())
    scope: dict[str, Any] = {}
    exec(compile(home.read("algebra/products.py"), "algebra/products.py", "exec"), scope)
    return SimpleNamespace(**{name: value for name, value in scope.items() if not name.startswith("_")})


class Unit:
    """Kernels over the same joints (all of one chain or loop, or one of a whole robot); compiled together at first use."""

    def __init__(self, library: Library, path: str) -> None:
        self.library, self.path = library, path
        self.record: dict[str, Any] = library.manifest["units"][path]
        self.layout = Layout.of(self.record)
        self.joint_names, self.joint_kinds = self.layout.names, self.layout.kinds
        self._kernels: dict[str, Kernel] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        # compiled code does not travel: a copy opens its folder itself
        return Library.unit, (self.library, self.path)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the kernels."""
        return tuple(self.record["kernels"])

    def kernel(self, name: str) -> Kernel:
        """The kernel of that name. UnknownNameError lists the others."""
        if name not in self._kernels:
            if name not in self.record["kernels"]:
                raise UnknownNameError("kernel", name, self.names)
            self._kernels[name] = Kernel(self, name)
        return self._kernels[name]

    @cached_property
    def compiled(self) -> ctypes.CDLL | None:
        """The compiled C, or None where Python text has to serve."""
        return compile_library(self.path.rsplit("/", 1)[-1], self.library.read(f"{self.path}.c"))

    @cached_property
    def text(self) -> dict[str, Callable[..., tuple[Any, ...]]]:
        """The functions of the Python text."""
        file = f"{self.path}.py"
        scope: dict[str, Any] = {}
        exec(compile(self.library.read(file), str(self.library.folder / file), "exec"), scope)
        return {name: scope[name] for name in self.names}


class Kernel:
    """One kernel: call it on arrays (leading batch dimensions broadcast), or take it as a casadi.Function."""

    def __init__(self, unit: Unit, name: str) -> None:
        self.unit, self.name = unit, name
        self.record: dict[str, Any] = unit.record["kernels"][name]
        self.body: tuple[str, ...] = tuple(key for key, _ in self.record["inputs"])
        self.shape: tuple[int, ...] = tuple(self.record["shape"])
        self.layout = unit.layout
        passed = {key: tuple(size) for key, size in self.record["inputs"] if key not in OF_Q}
        self.inputs: dict[str, tuple[int, ...]] = {**({"q": (self.layout.nq,)} if len(passed) < len(self.body) else {}), **passed}

    def __reduce__(self) -> tuple[Any, ...]:
        return Unit.kernel, (self.unit, self.name)

    def __call__(self, *values: ArrayLike) -> Array:
        """Evaluates at inputs of shape (..., size). Raises WrongSizeError or NotFiniteError."""
        q = values[0] if len(values) == 1 else None
        if type(q) is np.ndarray and q.shape == self._single and q.dtype is _F64 and q.flags.c_contiguous:
            return self._evaluate([q], ())
        return self._evaluate(*self._checked(values))

    def _evaluate(self, arrays: Sequence[Array], batch: tuple[int, ...]) -> Array:
        """At contiguous float64 arrays of the right shapes, all with the same batch dimensions."""
        if self.layout.floating and "base" in self.body:
            self.layout.check_base(arrays[0])
        out: Array = np.empty((*batch, *self.shape))
        if self._entries is None:
            for name, array in zip(self.inputs, arrays, strict=True):
                finite(array, name)
            # sizes are written out: -1 has no meaning where the batch is empty
            flat = [np.moveaxis(a.reshape(*batch, math.prod(shape)), -1, 0) for a, shape in zip(arrays, self.inputs.values(), strict=True)]
            entries = out.reshape(*batch, math.prod(self.shape))
            for k, result in enumerate(self.unit.text[self.name](*self._body_inputs(flat, np))):
                entries[..., k] = result
            return self._defined(out)
        single, many = self._entries
        # the interface dictionary is the cheapest way to an address that numpy offers
        addresses = [a.__array_interface__["data"][0] for a in arrays]
        address = out.__array_interface__["data"][0]
        bad = many(math.prod(batch), *addresses, address) if batch else single(*addresses, address)
        if bad:
            for name, array in zip(self.inputs, arrays, strict=True):
                finite(array, name)
        return self._defined(out)

    def _defined(self, out: Array) -> Array:
        """A kernel that divides has no value where the divisor vanishes, as the mass matrix of bodies without mass."""
        if self.record["divisions"] and not np.isfinite(out).all():
            raise DegenerateError(f"{self.name} has no value here: a divisor vanishes (a body or a direction without inertia)")
        return out

    def _checked(self, values: Sequence[ArrayLike]) -> tuple[list[Array], tuple[int, ...]]:
        if len(values) != len(self.inputs):
            raise WrongSizeError(f"{self.name} takes {', '.join(self.inputs)}; {len(values)} arrays given")
        arrays, batches = [], []
        for value, (name, shape) in zip(values, self.inputs.items(), strict=True):
            array = numeric(value, name)
            split = array.ndim - len(shape)
            if array.shape[split:] != shape or split < 0:
                wanted = ", ".join(str(k) for k in shape)
                raise WrongSizeError(f"{name} of {self.unit.path}: shape {array.shape} given, (..., {wanted}) needed")
            arrays.append(array)
            batches.append(array.shape[:split])
        batch = batches[0]
        if batches.count(batch) != len(batches):
            try:
                batch = np.broadcast_shapes(*batches)
            except ValueError:
                raise WrongSizeError(f"{self.name}: batch dimensions {batches} do not broadcast") from None
            arrays = [np.broadcast_to(a, (*batch, *shape)) for a, shape in zip(arrays, self.inputs.values(), strict=True)]
        return [np.ascontiguousarray(a) for a in arrays], batch

    @cached_property
    def _single(self) -> tuple[int, ...] | None:
        """Shape of the only input, for kernels that have one: the common case, checked without loops."""
        return next(iter(self.inputs.values())) if len(self.inputs) == 1 else None

    @cached_property
    def _entries(self) -> tuple[Any, Any] | None:
        """Compiled entry points for one configuration and for a batch; None where Python text has to serve."""
        if self.unit.compiled is None:
            return None
        entries = []
        for suffix, head in (("", []), ("_batch", [ctypes.c_int64])):
            function = getattr(self.unit.compiled, self.record["symbol"] + suffix)
            function.restype = ctypes.c_int
            function.argtypes = head + [ctypes.c_void_p] * (len(self.inputs) + 1)
            entries.append(function)
        return entries[0], entries[1]

    def _body_inputs(self, flat: Sequence[Any], module: Any) -> list[Any]:
        """Inputs of the body from flat public inputs: trigonometry of q by `module` (numpy or casadi), the rest as it is."""
        named = dict(zip(self.inputs, flat, strict=True))
        return [self.layout.body_input(name, named["q"], module) if name in OF_Q else named[name] for name in self.body]

    def symbolic(self, *values: Any) -> Any:
        """The kernel at casadi SX inputs (q a vector, others in their shape), as an SX matrix of its shape (3-D results: (6, n*n)).

        Raises WrongSizeError.
        """
        import casadi

        given = [casadi.SX(value) for value in values]
        sizes = {name: math.prod(shape) for name, shape in self.inputs.items()}
        if [x.numel() for x in given] != list(sizes.values()):
            raise WrongSizeError(f"{self.name} takes {sizes} numbers; {[x.numel() for x in given]} given")
        flat = [x.T.elements() if len(shape) > 1 else x.elements() for x, shape in zip(given, self.inputs.values(), strict=True)]
        results = casadi.vertcat(casadi.SX(0, 1), *[casadi.SX(r) for r in self.unit.text[self.name](*self._body_inputs(flat, casadi))])
        rows, columns = self.shape[0], math.prod(self.shape[1:])
        return casadi.reshape(results, columns, rows).T if len(self.shape) > 1 else results

    @cached_property
    def casadi(self) -> Any:
        """The kernel as a casadi.Function of its public inputs (q, v, ...), built from symbols: derivatives of any order are exact."""
        import casadi

        symbols = [casadi.SX.sym(name, *shape) for name, shape in self.inputs.items()]
        return casadi.Function(self.name, symbols, [self.symbolic(*symbols)], list(self.inputs), [self.name])
