"""The copy of the tree that holds the faults, and its build. The tree itself is never changed."""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

from schemata import HEADER, with_branches

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "mutants"
SOURCE, BUILD, CHECK, PLAIN = WORK / "src", WORK / "build", WORK / "check", WORK / "plain"
PARTS = ["CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "cmake", "docs", "examples", "verify", "analytic",
         "renderer", "reports", "tools", "tests", "bench/scenes"]
OPTIONS = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DPLUMBLINE_BENCH=OFF", "-DPLUMBLINE_MUTANTS=ON",
           "-DPLUMBLINE_NATIVE=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=6"]
# No warnings: a fault may leave a variable without use.
WITH_FAULTS = f"-DCMAKE_CXX_FLAGS=-w -include {WORK}/plumbline_mutants.h"


def files_of(folder):
    return {path.relative_to(folder) for part in PARTS
            for path in [folder / part, *(folder / part).rglob("*")] if path.is_file() and "__pycache__" not in path.parts}


def write_if_other(path, content):
    """So that what is the same is not built again."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def write_copy(mutants):
    """Writes the tree with all `mutants`, whose files are named as in the tree itself."""
    by_file = {}
    for mutant in mutants:
        by_file.setdefault(pathlib.Path(mutant.file).relative_to(ROOT), []).append(mutant)
    wanted = files_of(ROOT)
    for name in files_of(SOURCE) - wanted:
        (SOURCE / name).unlink()
    for name in wanted:
        content = (ROOT / name).read_bytes()
        write_if_other(SOURCE / name, with_branches(content, by_file[name]) if name in by_file else content)
        if os.access(ROOT / name, os.X_OK):
            (SOURCE / name).chmod(0o755)
    size = max((m.number for m in mutants), default=0) + 1
    write_if_other(WORK / "plumbline_mutants.h", (HEADER % {"size": size}).encode())


def configure(source, folder, *more):
    run = subprocess.run(["cmake", "-S", source, "-B", folder, *OPTIONS, *more], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(run.stdout + run.stderr)


def blamed(output, mutants):
    """The numbers of the mutants on whose lines a compiler reports errors."""
    lines = {}
    for mutant in mutants:
        name = str(pathlib.Path(mutant.file).relative_to(ROOT))
        for line in range(mutant.line, mutant.line + mutant.find.count("\n") + 1):
            lines.setdefault((name, line), set()).add(mutant.number)
    numbers = set()
    for path, line in re.findall(rf"^{re.escape(str(SOURCE))}/(\S+?):(\d+):(?:\d+:)? (?:fatal )?error:", output, re.MULTILINE):
        numbers |= lines.get((path, int(line)), set())
    return numbers


def alone(source, folder, *more):
    """The compiler's commands for each source alone, in `folder`; what the build generates is there."""
    configure(source, folder, "-DCMAKE_UNITY_BUILD=OFF", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *more)
    subprocess.run(["cmake", "--build", folder, "--target", "plumbline_build_stamp"], capture_output=True, check=True)
    return json.loads((folder / "compile_commands.json").read_text())


def syntax_errors(command):
    arguments = [a for a in shlex.split(command["command"])[1:] if not a.startswith("-march")]
    place = arguments.index("-o")
    del arguments[place:place + 2]
    run = subprocess.run(["clang++-14", "-fsyntax-only", "-ferror-limit=0", *arguments], cwd=command["directory"],
                         capture_output=True, text=True)
    return run.stderr if run.returncode else ""


def not_valid(mutants, parts):
    """The numbers of the mutants that clang does not accept in the sources of `parts`, each compiled alone."""
    commands = [c for c in alone(SOURCE, CHECK, WITH_FAULTS)
                if c["file"].startswith(tuple(f"{SOURCE}/{part}/" for part in parts))]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        output = "\n".join(pool.map(syntax_errors, commands))
    return blamed(output, mutants), output


def build(jobs):
    """Builds everything that can be built, and returns what the compiler said where it could not."""
    configure(SOURCE, BUILD, "-DCMAKE_UNITY_BUILD=ON", WITH_FAULTS)
    run = subprocess.run(["ninja", "-C", BUILD, "-k", "0", f"-j{jobs}"], capture_output=True, text=True)
    return run.stdout if run.returncode else ""
