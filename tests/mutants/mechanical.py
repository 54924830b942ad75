"""Small mechanical faults in C++ sources, found by clang's syntax tree.

Constants are changed, operators and comparisons replaced, conditions turned round, arguments of one type swapped,
statements dropped, results replaced by 0 or 1. All of them are `Mutant`s of an expression or a statement inside a
function, so that both versions can stand in one program (schemata.py).
"""

import concurrent.futures
import hashlib
import os
import pathlib
import re
import shlex

from schemata import Mutant

# What an operator is mistaken for.
OPERATORS = {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["/"],
             "<": ["<=", ">"], "<=": ["<", ">"], ">": [">=", "<"], ">=": [">", "<"], "==": ["!="], "!=": ["=="],
             "&&": ["||"], "||": ["&&"], "&": ["|"], "|": ["&"], "^": ["|"], "<<": [">>"], ">>": ["<<"],
             "+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="]}
# Calls that nobody would miss: what they do is for readers, or for the optimiser.
HARMLESS = re.compile(r"(static_cast<void>|std::move|reserve|shrink_to_fit|prefetch|assert)\b")
# A literal in such a place need not be a constant expression.
LITERAL_HOMES = {"BINARY_OPERATOR", "COMPOUND_ASSIGNMENT_OPERATOR", "CALL_EXPR", "RETURN_STMT", "CONDITIONAL_OPERATOR",
                 "PAREN_EXPR", "UNEXPOSED_EXPR", "CXX_FUNCTIONAL_CAST_EXPR", "CXX_STATIC_CAST_EXPR", "VAR_DECL",
                 "UNARY_OPERATOR"}
FUNCTIONS = {"FUNCTION_DECL", "CXX_METHOD", "CONSTRUCTOR", "DESTRUCTOR", "FUNCTION_TEMPLATE", "CONVERSION_FUNCTION",
             "LAMBDA_EXPR"}
# Not entered: no code that runs, or only on the way out.
CLOSED = {"STATIC_ASSERT", "CXX_THROW_EXPR", "TYPE_REF", "TEMPLATE_REF", "DECL_REF_EXPR",
          "ENUM_DECL", "UNION_DECL", "TYPE_ALIAS_DECL"}


class Finder:
    """The candidates of one translation unit in the files that are asked for."""

    def __init__(self, files):
        self.files = files  # path as text → its bytes
        self.found = {}     # (file, start, end, replacement) → Mutant

    def text(self, cursor):
        extent = cursor.extent
        if extent.start.file is None or extent.start.file.name != self.name or extent.end.file.name != self.name:
            return None
        return self.source[extent.start.offset:extent.end.offset].decode()

    def add(self, cursor, operator, replacement, statement=False):
        start, end = cursor.extent.start, cursor.extent.end
        text = self.source[start.offset:end.offset].decode()
        if not text or "#" in text or "//" in replacement:
            return
        if statement and self.source[end.offset:end.offset + 1] != b";":
            return
        key = (self.name, start.offset, end.offset, replacement)
        self.found[key] = Mutant(file=self.name, start=start.offset, end=end.offset, line=start.line,
                                 operator=operator, find=text, replace=" ".join(replacement.split()),
                                 statement=statement, constexpr=self.in_constexpr)

    def visit_unit(self, unit):
        for cursor in unit.cursor.get_children():
            file = cursor.location.file
            if file is not None and file.name in self.files:
                self.name, self.source, self.in_constexpr = file.name, self.files[file.name], False
                self.visit(cursor, None, False)

    def visit(self, cursor, parent, inside):
        kind = cursor.kind.name
        if kind in CLOSED:
            return
        was = self.in_constexpr
        if kind in FUNCTIONS:
            head = (self.text(cursor) or "").split("{")[0]
            if "consteval" in head:
                return
            self.in_constexpr = was or "constexpr" in head
        elif kind == "VAR_DECL" and re.search(r"\bconstexpr\b|\bstatic\b", (self.text(cursor) or "").split("=")[0]):
            return
        if inside:
            self.mutate(cursor, kind, parent)
        children = list(cursor.get_children())
        if kind == "CASE_STMT":
            children = children[1:]
        if kind == "IF_STMT" and re.match(r"if\s+constexpr", self.text(cursor) or ""):
            children = children[1:]
        for child in children:
            self.visit(child, cursor, inside or kind == "COMPOUND_STMT")
        self.in_constexpr = was

    def mutate(self, cursor, kind, parent):
        if parent.kind.name == "COMPOUND_STMT":
            self.drop(cursor, kind)
        if kind in ("BINARY_OPERATOR", "COMPOUND_ASSIGNMENT_OPERATOR"):
            self.operator(cursor, list(cursor.get_children()), kind, parent)
        elif kind == "CALL_EXPR":
            arguments = list(cursor.get_arguments())
            if cursor.spelling.startswith("operator") and len(arguments) == 2:
                self.operator(cursor, arguments, kind, parent)
            else:
                self.swap(cursor, arguments)
                self.minimum(cursor)
        elif kind in ("INTEGER_LITERAL", "FLOATING_LITERAL") and parent.kind.name in LITERAL_HOMES:
            self.literal(cursor, kind)
        elif kind == "RETURN_STMT":
            self.result(cursor)
        elif kind == "IF_STMT":
            condition = next(iter(cursor.get_children()))
            text = self.text(condition)
            if text and condition.kind.is_expression() and not re.match(r"if\s+constexpr", self.text(cursor) or ""):
                self.add(condition, "condition", f"!({text})")

    def drop(self, cursor, kind):
        while kind == "UNEXPOSED_EXPR":
            children = list(cursor.get_children())
            if len(children) != 1:
                return
            cursor, kind = children[0], children[0].kind.name
        text = self.text(cursor)
        if kind in ("CALL_EXPR", "COMPOUND_ASSIGNMENT_OPERATOR", "BINARY_OPERATOR", "UNARY_OPERATOR") and text \
                and not HARMLESS.search(text):
            self.add(cursor, "dropped", "", statement=True)

    def operator(self, cursor, operands, kind, parent):
        if len(operands) != 2 or any(self.text(operand) is None for operand in operands):
            return
        left, right = operands
        between = self.source[left.extent.end.offset:right.extent.start.offset].decode()
        sign = between.strip()
        if sign.endswith("=") and sign not in ("==", "!=", "<=", ">="):
            if parent.kind.name != "COMPOUND_STMT":
                return
            for other in OPERATORS.get(sign, []):
                self.add(cursor, f"{sign} → {other}", f"{self.text(left)} {other} {self.text(right)};",
                         statement=True)
            return
        for other in OPERATORS.get(sign, []):
            self.add(cursor, f"{sign} → {other}", f"{self.text(left)} {other} {self.text(right)}")

    def swap(self, cursor, arguments):
        text = self.text(cursor)
        for a, b in zip(arguments, arguments[1:]):
            one, two = self.text(a), self.text(b)
            if not text or not one or not two or one == two:
                continue
            if a.type.get_canonical().spelling != b.type.get_canonical().spelling or not a.type.spelling:
                continue
            base = cursor.extent.start.offset
            source = text.encode()
            swapped = (source[:a.extent.start.offset - base].decode() + two +
                       source[a.extent.end.offset - base:b.extent.start.offset - base].decode() + one +
                       source[b.extent.end.offset - base:].decode())
            if cursor.type.spelling != "void" and not re.match(r"(std::)?(min|max)\b", text):
                self.add(cursor, "swapped arguments", swapped)

    def minimum(self, cursor):
        text = self.text(cursor) or ""
        for one, other in (("std::min", "std::max"), ("std::max", "std::min")):
            if text.startswith(one):
                self.add(cursor, f"{one} → {other}", other + text[len(one):])

    def literal(self, cursor, kind):
        text = self.text(cursor)
        if text is None or not re.match(r"[\d.]", text):
            return
        if kind == "INTEGER_LITERAL":
            self.add(cursor, "constant", f"{text} + 1")
            if not re.fullmatch(r"0[uUlL]*", text):
                self.add(cursor, "constant", f"{text} - 1")
            return
        zero = re.fullmatch(r"0?\.?0*[fF]?", text)
        suffix = "f" if text[-1] in "fF" else ""
        if zero:
            self.add(cursor, "constant", f"1.0{suffix}")
            return
        for change in ("* 1.1", "* 0.5", "* 2.0"):
            self.add(cursor, "constant", f"{text} {change}{suffix}")

    def result(self, cursor):
        children = list(cursor.get_children())
        if len(children) != 1:
            return
        value, text = children[0], self.text(children[0])
        if not text:
            return
        kind = value.type.get_canonical().kind.name
        if kind == "BOOL":
            self.add(value, "result", f"!({text})")
        elif kind in ("FLOAT", "DOUBLE"):
            self.add(value, "result", f"decltype({text})(0)")
            self.add(value, "result", f"decltype({text})(1)")


def candidates_of_unit(command, files):
    """The candidates that one compiler command sees, as a list of Mutants."""
    import clang.cindex as clang
    arguments = [a for a in shlex.split(command["command"])[1:] if not a.startswith("-march")]
    place = arguments.index("-o")
    del arguments[place:place + 2]
    arguments = [a for a in arguments if a not in ("-c", command["file"])]
    unit = clang.Index.create().parse(command["file"], args=arguments)
    errors = [str(d) for d in unit.diagnostics if d.severity >= clang.Diagnostic.Error]
    if errors:
        raise RuntimeError(f"clang does not read {command['file']}: {errors[0]}")
    finder = Finder({name: pathlib.Path(name).read_bytes() for name in files})
    finder.visit_unit(unit)
    return list(finder.found.values())


def all_candidates(commands, root, parts):
    """Every candidate in the sources and headers of `parts`, by the compiler's `commands` for each source alone."""
    folders = tuple(f"{root}/{part}/" for part in parts)
    files = [str(path) for folder in folders for path in pathlib.Path(folder).rglob("*") if path.suffix in (".h", ".cpp")]
    commands = [c for c in commands if c["file"].startswith(folders)]
    found = {}
    with concurrent.futures.ProcessPoolExecutor() as pool:
        for mutants in pool.map(candidates_of_unit, commands, [files] * len(commands)):
            for mutant in mutants:
                found[mutant.file, mutant.start, mutant.end, mutant.replace] = mutant
    return sorted(found.values(), key=lambda m: (m.file, m.start, m.end, m.replace))


def rank(seed, *key):
    """A number that looks random and depends on nothing else: a choice by it hardly changes when the sources do."""
    return hashlib.sha256("\n".join([seed, *key]).encode()).digest()


def choose(candidates, count, seed, root):
    """At most `count` of the candidates, one of a line, none within another: the same for the same seed and lines,
    wherever the tree `root` lies."""
    lines, seen = {}, {}
    for mutant in candidates:
        lines.setdefault((mutant.file, mutant.line), []).append(mutant)
    ranked = []
    for (file, line), here in sorted(lines.items()):
        texts = "".join(sorted({m.find for m in here}))
        again = seen[file, texts] = seen.get((file, texts), 0) + 1  # lines that are alike
        ranked.append((rank(seed, os.path.relpath(file, root), texts, str(again)), here))
    chosen, taken = [], {}
    for order, here in sorted(ranked, key=lambda item: item[0]):
        if len(chosen) == count:
            break
        kinds = {}
        for mutant in here:
            kinds.setdefault(mutant.operator, []).append(mutant)
        kind = min(kinds, key=lambda name: rank(seed, name, order.hex()))
        mutant = min(kinds[kind], key=lambda m: rank(seed, m.key(), order.hex()))
        spans = taken.setdefault(mutant.file, [])
        if all(mutant.end <= start or end <= mutant.start for start, end in spans):
            spans.append((mutant.start, mutant.end))
            chosen.append(mutant)
    return sorted(chosen, key=lambda m: (m.file, m.start))
