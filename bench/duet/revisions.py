"""The two trees that are compared: copies under build/compare, each with a build of the worker.

The user's tree is never touched. A copy is brought to a revision by writing the files that differ, so that what two
comparisons share is not built again."""

import io
import os
import pathlib
import shutil
import subprocess
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
FOLDER = ROOT / "build" / "compare"
WORK = (".", "WORK")
# As the preset `release` has it.
OPTIONS = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DPLUMBLINE_NATIVE=ON", "-DPLUMBLINE_TESTS=OFF", "-DPLUMBLINE_BENCH=OFF",
           "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=6"]


class RevisionError(Exception):
    pass


def git(*arguments, root=ROOT):
    run = subprocess.run(["git", *arguments], cwd=root, capture_output=True)
    if run.returncode:
        raise RevisionError(run.stderr.decode(errors="replace").strip())
    return run.stdout


def full_name(revision, root=ROOT):
    """The hash of a revision; of the tree as it is, that of its commit with a plus where it differs from it."""
    if revision not in WORK:
        try:
            return git("rev-parse", "--verify", "--quiet", "--end-of-options", revision + "^{commit}", root=root).decode().strip()
        except RevisionError:
            raise RevisionError(f"'{revision}' is no revision of this repository (give a commit, tag or branch, or . for the "
                                "tree as it is)") from None
    head = git("rev-parse", "HEAD", root=root).decode().strip()
    return head + ("+" if git("status", "--porcelain", root=root) else "")


def files_of(revision, root=ROOT):
    """Content and whether it is a program, by path."""
    if revision not in WORK:
        with tarfile.open(fileobj=io.BytesIO(git("archive", "--format=tar", full_name(revision, root), root=root))) as tar:
            return {m.name: (tar.extractfile(m).read(), bool(m.mode & 0o100)) for m in tar if m.isfile()}
    names = git("ls-files", "-z", "--cached", "--others", "--exclude-standard", root=root).decode().split("\0")
    paths = [(name, root / name) for name in names if name]
    return {name: (path.read_bytes(), os.access(path, os.X_OK)) for name, path in paths if path.is_file()}


def bring_to(folder, files):
    """Writes what differs, removes what is not among them."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in [p for p in folder.rglob("*") if p.is_file()]:
        if str(path.relative_to(folder)) not in files:
            path.unlink()
    for name, (content, program) in files.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        path.chmod(0o755 if program else 0o644)


def shared_objects(place):
    """How to compile only once what both trees share, where ccache is installed: paths count from the copy's own place."""
    if not shutil.which("ccache"):
        return [], os.environ
    return (["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"],
            {**os.environ, "CCACHE_BASEDIR": str(place), "CCACHE_NOHASHDIR": "1", "CCACHE_DIR": str(FOLDER / "ccache")})


def build(side, revision):
    """The worker of a revision, in the place of `side`, "a" or "b": names of one length, which say nothing of speed."""
    place = FOLDER / side
    bring_to(place / "src", files_of(revision))
    launcher, environment = shared_objects(place)
    log = place / "build.log"
    with open(log, "w") as out:
        for command in (["cmake", "-S", HERE, "-B", place / "build", f"-DPLUMBLINE_TREE={place}/src", *OPTIONS, *launcher],
                        ["cmake", "--build", place / "build", "--target", "plumbline_duet_worker"]):
            if subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, env=environment).returncode:
                tail = "\n".join(log.read_text(errors="replace").splitlines()[-15:])
                raise RevisionError(f"{revision} does not build with the parts of this tree (bench/duet): it is broken, or its headers "
                                    f"are too old for them. {log} ends with:\n{tail}")
    return place / "build" / "plumbline_duet_worker"


def code_of(program, side):
    """What a program is without its symbols and the name of its place."""
    with tempfile.TemporaryDirectory() as folder:
        stripped = pathlib.Path(folder) / "stripped"
        subprocess.run(["strip", "--strip-all", "-o", stripped, program], check=True)
        return stripped.read_bytes().replace(f"/compare/{side}/".encode(), b"/compare/?/")


def same_code(program_a, program_b):
    return code_of(program_a, "a") == code_of(program_b, "b")
