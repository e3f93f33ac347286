# SPDX-License-Identifier: BSD-3-Clause
"""Choice of the build of the compiled parts for this processor.

An installation from source has one build, for the machine that compiled it. A wheel has two:
one for every x86-64 processor, and one (suffix ``_v3``) for those with the instructions x86-64-v3
(AVX2 and FMA, from 2013 on), which is 1.2 to 1.5 times faster. The results of the two agree to
rounding, not to the last bit: v3 fuses multiplications and additions. The environment variable
``PYEHL_CPU`` set to ``baseline`` or ``x86-64-v3`` forces one of them.
"""

import os
import sys
from importlib.util import find_spec
from pathlib import Path

from pyehl.errors import InputError

VARIABLE = "PYEHL_CPU"
BASELINE, V3 = "baseline", "x86-64-v3"
# Features that x86-64-v3 adds, as Linux names them (psABI of x86-64, microarchitecture levels)
V3_FLAGS = {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"}


def processor_flags(path: Path = Path("/proc/cpuinfo")) -> set[str]:
    """Features of the processor as Linux names them; none if they are not reported."""
    try:
        text = path.read_text(encoding="ascii", errors="replace")
    except OSError:
        return set()
    for line in text.splitlines():
        name, _, value = line.partition(":")
        if name.strip() == "flags":
            return set(value.split())
    return set()


def choose(wanted: str, has_v3: bool, flags: set[str]) -> str:
    """Choose a build: the suffix of its extension and of its program, '' or '_v3'.

    `wanted` is the value of ``PYEHL_CPU``; with '' the features `flags` of the processor decide.
    `has_v3`: there is a build for x86-64-v3 besides the other one. InputError if the wanted build
    does not exist, or the processor cannot run it.
    """
    if wanted not in ("", BASELINE, V3):
        raise InputError(f"{VARIABLE}={wanted}: '{BASELINE}' or '{V3}' was expected")
    if wanted and not has_v3:
        raise InputError(
            f"{VARIABLE}={wanted}: this installation has one build only\n"
            "expected: a wheel, or no such variable"
        )
    able = flags >= V3_FLAGS
    if wanted == V3 and not able:
        missing = ", ".join(sorted(V3_FLAGS - flags))
        raise InputError(f"{VARIABLE}={V3}: missing on this processor: {missing}")
    return "_v3" if has_v3 and able and wanted != BASELINE else ""


def suffix() -> str:
    """Suffix of the build that this process uses."""
    has_v3 = find_spec("pyehl._core_v3") is not None
    return choose(os.environ.get(VARIABLE, ""), has_v3, processor_flags() if has_v3 else set())


def run_program() -> None:
    """Run the program ``ehl`` of a wheel in place of this process, with the same arguments.

    It is the build of the extension, so that both give the same bits.
    """
    try:
        program = Path(__file__).with_name("bin") / f"ehl{suffix()}"
    except InputError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    os.execv(program, [str(program), *sys.argv[1:]])
