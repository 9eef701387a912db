"""Numbers and threads of mist; private, the package ``mist`` has the public names."""

from pathlib import Path
from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

version: str

__all__ = [
    "Material",
    "Program",
    "Result",
    "Scatterer",
    "ciede2000",
    "colour_table",
    "colour_tolerance",
    "colours",
    "export_file",
    "families",
    "fit_program",
    "forget_threads",
    "formatted",
    "merge_shards",
    "set_threads",
    "threads",
    "version",
]

def ciede2000(first: list[float], second: list[float]) -> float: ...
def colour_table(
    material: Material, name: str, query: str, formats: list[str]
) -> list[str]: ...
def colour_tolerance(program: Program, vary: list[str], step: float) -> str: ...
def colours(request: str) -> str: ...
def export_file(
    material: Material,
    path: Path,
    wavelengths: str | None,
    grid: str | None,
    rgb: bool,
    plugin: bool,
) -> tuple[bytes, str]: ...
def families() -> str: ...
def fit_program(
    program: Program, measured: str, vary: list[str], arguments: dict[str, Any]
) -> str: ...
def threads() -> int: ...
def set_threads(count: int | None = None) -> None: ...
def forget_threads() -> None: ...
def formatted(text: str, compat: bool) -> str: ...
def merge_shards(shards: list[Path], output: Path) -> int: ...

@final
class Material:
    def __new__(
        cls,
        model: str,
        parameters: list[tuple[str, str]],
        files: dict[str, str],
        compat: bool,
    ) -> Material: ...
    @property
    def model(self) -> str: ...
    @property
    def compat(self) -> bool: ...
    @property
    def files(self) -> dict[str, str]: ...
    def entries(self) -> list[tuple[str, str, bool, str | None, str, str, str]]: ...
    def at(self, wavelength: float) -> Material: ...
    def build(self) -> None: ...
    def is_coherent(self) -> bool: ...
    def mueller(
        self,
        theta_i: ArrayLike,
        theta_s: ArrayLike,
        phi_s: ArrayLike,
        rotation: ArrayLike,
        wavelength: ArrayLike | None,
        basis: str,
        out: NDArray[np.float64] | None,
    ) -> NDArray[np.float64]: ...
    def brdf(
        self,
        theta_i: ArrayLike,
        theta_s: ArrayLike,
        phi_s: ArrayLike,
        rotation: ArrayLike,
        wavelength: ArrayLike | None,
        incident: tuple[float, ...],
        sensitivity: tuple[float, ...],
        basis: str,
        out: NDArray[np.float64] | None,
    ) -> Any: ...
    def jones(
        self,
        theta_i: ArrayLike,
        theta_s: ArrayLike,
        phi_s: ArrayLike,
        rotation: ArrayLike,
        wavelength: ArrayLike | None,
        basis: str,
    ) -> NDArray[np.complex128]: ...

@final
class Program:
    def __new__(
        cls,
        text: str,
        files: dict[str, str],
        path: str | None,
        compat: bool,
        seed: int,
        limits: list[float | None],
    ) -> Program: ...
    @property
    def text(self) -> str: ...
    @property
    def files(self) -> dict[str, str]: ...
    @property
    def model(self) -> str: ...
    def columns(self) -> tuple[list[str], list[str], list[tuple[str, int | None]]]: ...
    def advice(self) -> list[tuple[Any, ...]]: ...
    def steps(self) -> int: ...
    def run(
        self, values: list[tuple[str, float]], threads: int | None, progress: Any
    ) -> Result: ...

@final
class Result:
    @property
    def results(self) -> str: ...
    @property
    def listing(self) -> str: ...
    @property
    def samples(self) -> str: ...
    @property
    def loops(self) -> list[str]: ...
    @property
    def steps(self) -> int: ...
    @property
    def evaluations(self) -> float: ...
    @property
    def seconds(self) -> float: ...
    @property
    def notices(self) -> list[tuple[Any, ...]]: ...
    def coordinates(self) -> NDArray[np.float64]: ...
    def outputs(self) -> NDArray[np.float64]: ...
    def errors(self) -> NDArray[np.float64]: ...

@final
class Scatterer:
    def __new__(
        cls,
        class_: str,
        parameters: list[tuple[str, str]],
        files: dict[str, str],
        compat: bool,
    ) -> Scatterer: ...
    @property
    def wave_number(self) -> float: ...
    def jones(
        self, k_in: list[float], k_out: list[float], in_plane: bool
    ) -> NDArray[np.complex128]: ...
