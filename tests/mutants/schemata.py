"""Many faults in one program: each is a branch on one number, which is read once from the environment.

PLUMBLINE_MUTANT=17 makes the seventeenth fault the program's; without it the program is the clean one.
PLUMBLINE_MUTANT_TRACE=FILE leaves a byte per fault: whether its place was reached.
"""

import dataclasses

HEADER = """#pragma once
#include <cstdio>
#include <cstdlib>
#include <type_traits>
namespace plumbline_mutants {
inline int chosen = 0;
inline unsigned char reached[%(size)d];
struct Trace {
  ~Trace() {
    const char* name = std::getenv("PLUMBLINE_MUTANT_TRACE");
    if (std::FILE* file = name ? std::fopen(name, "wb") : nullptr) {
      std::fwrite(reached, 1, sizeof reached, file);
      std::fclose(file);
    }
  }
};
inline Trace trace;
// Before all initialisation of static objects: some of them call mutated code.
static __attribute__((constructor(101))) void plumbline_mutants_start() {
  const char* text = std::getenv("PLUMBLINE_MUTANT");
  chosen = text ? std::atoi(text) : 0;
}
inline bool is(int n) {
  if (!reached[n]) reached[n] = 1;
  return chosen == n;
}
}
#define PLUMBLINE_MUTANT(n) ::plumbline_mutants::is(n)
// In constexpr functions: what the compiler computes is right.
#define PLUMBLINE_MUTANT_AT_RUN_TIME(n) (!std::is_constant_evaluated() && ::plumbline_mutants::is(n))
"""


@dataclasses.dataclass
class Mutant:
    """One change of one place. A named bug may consist of several with the same number."""
    file: str
    start: int  # bytes from the beginning of the file
    end: int
    line: int
    operator: str
    find: str
    replace: str
    statement: bool = False  # find is a statement without its semicolon, or statements with theirs
    constexpr: bool = False
    before: bool = False     # what is put in stands before `find`, which stays
    number: int = 0

    def key(self):
        """What names it as long as its line stays as it is."""
        return f"{self.operator}: {' '.join(self.find.split())} → {self.replace}"


def one_line(text):
    return " ".join(line.strip() for line in text.splitlines())


def branches(mutants, source):
    """The text that stands in the place of what `mutants`, all of the same place, change."""
    first = mutants[0]
    right = source[first.start:first.end].decode()
    whole = right.rstrip().endswith((";", "}"))
    for mutant in mutants:
        is_on = f"PLUMBLINE_MUTANT{'_AT_RUN_TIME' if mutant.constexpr else ''}({mutant.number})"
        wrong = one_line(mutant.replace)
        if mutant.before:
            right = f"if ({is_on}) {{ {wrong} }} {right}"
        elif mutant.statement:
            right = f"if ({is_on}) {{ {wrong} }} else " + (f"{{ {right} }}" if whole else right)
        else:
            right = f"({is_on} ? ({wrong}) : ({right}))"
    return right


def with_branches(source, mutants):
    """The text of a file with all `mutants` of it, as bytes; lines keep their numbers."""
    places = {}
    for mutant in mutants:
        places.setdefault((mutant.start, mutant.end), []).append(mutant)
    result, done = b"", 0
    for (start, end), here in sorted(places.items()):
        if start < done:
            raise ValueError(f"{here[0].file}: faults overlap at byte {start}: {here[0].key()}")
        result += source[done:start] + branches(here, source).encode()
        done = end
    return result + source[done:]
