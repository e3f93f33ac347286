"""The compiled extension: modules of fortran/bind.

Text goes in and comes out as bytes. Arrays are in Fortran order, first index X: _Array float64,
_Single float32, _Indices int32. They are passed by reference, never copied: another dtype or order
is refused with a ValueError. Every routine that can fail ends its results with (status, message).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_Single = NDArray[np.float32]
_Indices = NDArray[np.int32]

class _Solver:
    def open_case(
        self,
        text: bytes,
        origin: bytes,
        has_heights: int,
        heights: _Array,
        has_second: int,
        second: _Array,
    ) -> tuple[int, int, bytes]: ...
    def close_case(self, handle: int) -> tuple[int, bytes]: ...
    def advance(self, handle: int) -> tuple[int, int, int, bytes]: ...
    def interrupt(self, handle: int) -> tuple[int, bytes]: ...
    def write_files(self, handle: int, folder: bytes) -> tuple[int, bytes]: ...
    def resume(self, handle: int, results: bytes) -> tuple[bytes, int, bytes]: ...
    def save_state(self, handle: int, at_once: int) -> tuple[int, int, bytes]: ...
    def clear_states(self, handle: int) -> tuple[int, bytes]: ...
    def keep_states(
        self,
        handle: int,
        results: bytes,
        resumed: bytes,
        has_heights: int,
        heights: _Array,
        has_second: int,
        second: _Array,
    ) -> tuple[bytes, int, bytes]: ...
    def results(
        self, handle: int, of_plan: int, names: _Indices, kinds: _Indices, values: _Array
    ) -> tuple[int, int, int, bytes]: ...
    def progress(self, handle: int) -> tuple[bytes, int, bytes]: ...
    def work(self, handle: int) -> tuple[float, float, float, int, bytes]: ...
    def grid_shape(self, handle: int) -> tuple[int, int, int, bytes]: ...
    def axes(self, handle: int, x: _Array, y: _Array) -> tuple[int, bytes]: ...
    def field(self, handle: int, name: bytes, values: _Array) -> tuple[int, bytes]: ...

class _Predicted:
    def take_prediction(
        self, handle: int, left_out: float, unresolved: float
    ) -> tuple[int, bytes]: ...
    def start_fronts(self, handle: int) -> tuple[_Array, int, int, bytes]: ...
    def take_start(self, handle: int, why: bytes, pressure: _Array) -> tuple[int, bytes]: ...

class _Functions:
    def checkpoint_case(self, results: bytes) -> tuple[bytes, int, bytes]: ...
    # folder, kind, names, inputs, kept, force; then whether a result is completed, or the fresh one
    def check_folder(self, *given: bytes | int) -> tuple[int, bytes]: ...
    def begin_folder(self, *given: bytes | int) -> tuple[bytes, int, bytes]: ...
    def finish_folder(self, *given: bytes | int) -> tuple[int, bytes]: ...
    def needs_memory(self, what: bytes, bytes: float) -> tuple[int, bytes]: ...
    def memory_left(self, root: bytes) -> float: ...
    def about(self) -> tuple[bytes, bytes]: ...
    def deflection(
        self,
        engine: bytes,
        p: _Array,
        w: _Array,
        hx: float,
        hy: float,
        mirror: int,
        accuracy: float,
        threads: int,
        repeats: int,
    ) -> tuple[float, float, int, bytes]: ...
    def frictional_heat(
        self,
        text: bytes,
        p: _Array,
        h: _Array,
        touching: _Indices,
        x0: float,
        y0: float,
        hx: float,
        hy: float,
        mirror: int,
    ) -> tuple[int, float, _Array, int, float, int, bytes]: ...

class _Surfaces:
    def fractal(
        self,
        heights: _Array,
        length_x: float,
        length_y: float,
        rms_height: float,
        hurst: float,
        rolloff_wavenumber: float,
        lay_ratio: float,
        words: NDArray[np.int32],
        gaussian: int,
    ) -> tuple[int, bytes]: ...
    def filter_tile(
        self,
        heights: _Array,
        length_x: float,
        length_y: float,
        shortest: float,
        longest: float,
        gaussian: int,
    ) -> tuple[int, bytes]: ...
    def wave_tile(self, waves: _Single, tile: _Single) -> None: ...
    def driven_waves(
        self,
        tile: _Single,
        rows: _Indices,
        columns: _Indices,
        span: _Indices,
        weight: _Single,
        shift: int,
        total: _Single,
    ) -> None: ...
    def waves_between(
        self,
        tile: _Single,
        low: _Indices,
        columns: _Indices,
        span: _Indices,
        between: _Single,
        weight: _Single,
        total: _Single,
    ) -> None: ...
    def free_waves(
        self,
        tile: _Single,
        beside: _Single,
        low: _Indices,
        columns: _Indices,
        span: _Indices,
        between: _Single,
        weight: _Single,
        expansion: _Single,
        shift: int,
        total: _Single,
    ) -> None: ...
    def polynomials(self, values: _Single, coefficients: _Single, sums: _Single) -> None: ...
    def at_places(self, values: _Single, place: _Indices, total: _Single) -> None: ...
    def second_order(
        self, gain: _Array, variance: _Array, span: _Indices, total: _Single
    ) -> None: ...
    def film_pressure(
        self,
        change: _Single,
        place: _Indices,
        smooth: _Array,
        smooth_pressure: _Array,
        limit: float,
        factor: float,
        ends: float,
        film: _Array,
        pressure: _Array,
        increase: _Single,
        counts: _Indices,
    ) -> None: ...
    def ring_loads(self, ring: _Indices, pressure: _Array) -> int: ...
    def film_moved(self, *given: _Array | _Indices) -> None: ...

class _Lubricants:
    def properties(
        self, group: bytes, p: _Array, rise: _Array, log_viscosity: _Array, density: _Array
    ) -> tuple[int, bytes]: ...
    def flow_factors(
        self, law: int, exponent: float, b: _Array, gradient: _Array, found: _Array
    ) -> None: ...
    def sliding_stresses(self, law: int, exponent: float, b: _Array, stress: _Array) -> None: ...

class _Cases:
    # what makes the contact, see fortran/bind/ehl_f2py_case.f90; then border, smooth, domain, nodes
    def operating(
        self, *contact: float | Sequence[float]
    ) -> tuple[float, float, float, float, float, _Array, int]: ...
    def grid_defaults(
        self, *contact_and_grid: float | Sequence[float]
    ) -> tuple[int, _Array, int, int]: ...
    def inlet(self, group: bytes) -> tuple[float, float, float, int, bytes, bytes]: ...
    def sheet(
        self, temperature: float, viscosities: Sequence[float], density_15: float, expansion: float
    ) -> tuple[float, float]: ...

ehl_f2py_case: _Cases
ehl_f2py_solver: _Solver
ehl_f2py_predicted: _Predicted
ehl_f2py_functions: _Functions
ehl_f2py_surfaces: _Surfaces
ehl_f2py_lubricant: _Lubricants
