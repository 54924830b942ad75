"""Hash of the sources of the code under test: statistics over nights begin again where it changes."""

import hashlib
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNDER_TEST = ("analytic", "renderer", "verify")
NO_CODE = (".md", ".pyc")


def hash_of(root=ROOT):
    """Of names and contents, as 16 hexadecimal digits."""
    total = hashlib.sha256()
    for part in UNDER_TEST:
        for path in sorted(p for p in (root / part).rglob("*") if p.is_file() and p.suffix not in NO_CODE):
            total.update(f"{path.relative_to(root)}\0{path.stat().st_size}\0".encode())
            total.update(path.read_bytes())
    return total.hexdigest()[:16]


if __name__ == "__main__":
    print(hash_of())
