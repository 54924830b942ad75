#!/usr/bin/env python3
"""Writes docs/api.md from what Doxygen reads in the public headers.

usage: write_api.py XML_DIRECTORY OUTPUT DOXYGEN_VERSION
"""

from __future__ import annotations

import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

# In the order in which a reader wants them; what these need, detail/, comes after.
HEADERS = ["bsdf", "conventions", "pair", "joint", "stochastic", "dependent", "mean", "ratio", "image"]
HEADERS += ["waiver", "gtest", "autodiff"]
HEADERS += ["history/" + name for name in ("confidence_sequence", "regressions", "duet")]
HEADERS += ["history/" + name for name in ("change_points", "distribution_shift")]

INTRODUCTION = """# plumbline::verify

Made from the headers by `./run api` with Doxygen @VERSION@; what each is for: [verify/README.md](../verify/README.md). Names are in the namespace `plumbline::verify`.
"""


def inline(node) -> str:
    """The text of a node with code and emphasis marked."""
    text = node.text or ""
    for child in node:
        inner = inline(child)
        if child.tag == "computeroutput":
            text += f"`{inner}`" if "`" not in inner else inner
        elif child.tag in ("emphasis", "bold"):
            text += f"*{inner}*"
        elif child.tag in ("parameterlist", "simplesect", "itemizedlist", "verbatim", "programlisting"):
            pass  # blocks, see below
        else:
            text += {"ndash": "–", "mdash": "—", "sp": " ", "linebreak": "\n"}.get(child.tag, inner)
        text += child.tail or ""
    return text


def parameters(node) -> str:
    lines = []
    label = {"exception": "throws", "templateparam": "template"}.get(node.get("kind"), "")
    for item in node.findall("parameteritem"):
        names = ", ".join(inline(name) for name in item.iter("parametername"))
        meaning = paragraphs(item.find("parameterdescription")).replace("\n\n", " ")
        lines.append(f"- {label + ' ' if label else ''}`{names}`: {meaning}")
    return "\n".join(lines)


def verbatim(node) -> str:
    return "```cpp\n" + "".join(node.itertext()).strip("\n") + "\n```"


def blocks_of(para) -> list[str]:
    text = re.sub(r"[ \t]*\n[ \t]*", " ", inline(para)).strip()
    blocks = [text] if text else []
    for child in para:
        if child.tag == "parameterlist":
            blocks.append(parameters(child))
        elif child.tag == "simplesect":
            title = child.findtext("title") or child.get("kind", "")
            blocks.append(f"*{title.capitalize()}*: " + paragraphs(child))
        elif child.tag == "itemizedlist":
            items = [paragraphs(item).replace("\n\n", " ") for item in child.findall("listitem")]
            blocks.append("\n".join(f"- {item}" for item in items))
        elif child.tag in ("verbatim", "programlisting"):
            blocks.append(verbatim(child))
    return blocks


def paragraphs(node) -> str:
    if node is None:
        return ""
    return "\n\n".join(block for para in node.findall("para") for block in blocks_of(para) if block)


def documentation(node) -> str:
    parts = [paragraphs(node.find(kind)) for kind in ("briefdescription", "detaileddescription")]
    return "\n\n".join(part for part in parts if part)


def template_of(node) -> str:
    given = node.find("templateparamlist")
    if given is None:
        return ""
    names = []
    for parameter in given.findall("param"):
        text = inline(parameter.find("type"))
        if parameter.find("declname") is not None:
            text += " " + parameter.findtext("declname")
        if parameter.find("defval") is not None:
            text += " = " + inline(parameter.find("defval"))
        names.append(text)
    return f"template <{', '.join(names)}>\n"


def as_written(text: str) -> str:
    """C++ as the sources lay it out."""
    text = re.sub(r"<\s+", "<", re.sub(r"\s+>", ">", text))
    return re.sub(r" ([&*]+)(?=\w)", r"\1 ", text)


def signature(member) -> str:
    kind, name = member.get("kind"), member.findtext("name")
    if kind == "define":
        names = [p.findtext("defname") or "" for p in member.findall("param")]
        return f"{name}({', '.join(names)})" if names else name
    if kind == "enum":
        values = [value.findtext("name") for value in member.findall("enumvalue")]
        return f"enum class {name} {{ {', '.join(values)} }}"
    kind_of_type = inline(member.find("type")) if member.find("type") is not None else ""
    static = "static " if member.get("static") == "yes" and kind == "function" else ""
    text = template_of(member) + f"{static}{kind_of_type} {name}".strip()
    if kind == "function":
        text += member.findtext("argsstring") or "()"
    elif kind == "typedef":
        text = template_of(member) + f"using {name} = {kind_of_type}"
    elif member.find("initializer") is not None:
        text += " " + inline(member.find("initializer"))
    return as_written(re.sub(r"\s*=\s*(delete|default)$", r" = \1", text))


def member_rows(compound) -> list[str]:
    """Fields as a table, then functions, each with what is said of it."""
    fields, functions = [], []
    for member in compound.iter("memberdef"):
        if member.get("prot") != "public" or member.findtext("name", "").startswith("operator"):
            continue
        said = documentation(member)
        if member.get("kind") == "variable":
            one_line = re.sub(r"\s+", " ", said).replace("|", "\\|")
            declared = signature(member).replace("|", "\\|")
            fields.append(f"| `{declared}` | {one_line} |")
        elif member.get("kind") in ("function", "enum", "typedef") and said:
            functions.append(f"```cpp\n{signature(member)}\n```\n\n{said}")
    rows = []
    if fields:
        rows.append("\n".join(["| field | |", "|---|---|"] + fields))
    return rows + functions


def entries_by_header(directory: Path) -> dict[str, list[tuple[int, str]]]:
    """What each header declares, by line."""
    entries: dict[str, list[tuple[int, str]]] = {}

    def add(node, title: str, body: list[str]) -> None:
        place = node.find("location")
        header = place.get("file").removeprefix("plumbline/verify/").removesuffix(".h")
        text = "\n\n".join([f"### {title}"] + [part for part in body if part])
        entries.setdefault(header, []).append((int(place.get("line")), text))

    for file in sorted(directory.glob("*.xml")):
        if file.name == "index.xml":
            continue
        for compound in ElementTree.parse(file).getroot().iter("compounddef"):
            kind = compound.get("kind")
            if kind in ("struct", "class") and compound.get("prot") == "public":
                name = compound.findtext("compoundname").removeprefix("plumbline::verify::")
                said = documentation(compound)
                if said:
                    add(compound, f"`{kind} {name}`", [said] + member_rows(compound))
            elif kind in ("namespace", "file"):
                for member in compound.iter("memberdef"):
                    said = documentation(member)
                    define = member.get("kind") == "define"
                    if not said or define != (kind == "file"):
                        continue
                    title = f"`{member.findtext('name')}`"
                    add(member, title, [f"```cpp\n{signature(member)}\n```", said])
    return entries


def main() -> None:
    directory, output = Path(sys.argv[1]), Path(sys.argv[2])
    entries = entries_by_header(directory)
    order = [h for h in HEADERS if h in entries]
    order += sorted(h for h in entries if h not in order)
    text = INTRODUCTION.replace("@VERSION@", sys.argv[3])
    for header in order:
        text += f"\n## {header}.h\n"
        for _, entry in sorted(set(entries[header])):
            text += f"\n{entry}\n"
    output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
