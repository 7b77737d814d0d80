# SPDX-License-Identifier: MIT
"""The tests that tests/README.md names exist: a promise whose test was renamed has none."""
import ast
import fnmatch
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TESTS = ROOT / "tests"


def cpp_names(text):
    """Suite.Test of GoogleTest; those with parameters as Prefix/Suite.Test, too."""
    prefixes = {}
    for prefix, suite in re.findall(r"INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)", text):
        prefixes.setdefault(suite, [""]).append(f"{prefix}/")
    return {f"{prefix}{suite}.{name}"
            for suite, name in re.findall(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", text)
            for prefix in prefixes.get(suite, [""])}


def python_names(module, text):
    """The module, its classes and their tests; tests without their class, too."""
    names = {module}
    for node in ast.parse(text).body:
        if isinstance(node, ast.ClassDef):
            names.add(f"{module}.{node.name}")
            for member in node.body:
                if isinstance(member, ast.FunctionDef) and member.name.startswith("test_"):
                    names |= {f"{module}.{node.name}.{member.name}", member.name}
    return names


def known_names():
    names = set()
    for file in TESTS.rglob("*.cc"):
        names |= cpp_names(file.read_text())
    for file in TESTS.rglob("*.py"):
        names |= python_names(file.stem, file.read_text())
    for file in TESTS.rglob("CMakeLists.txt"):
        names |= set(re.findall(r"add_test\(NAME ([\w.]+)", file.read_text()))
    names |= {f"fuzz.{file.stem[:-len('_fuzz')]}" for file in TESTS.glob("fuzz/*_fuzz.cc")}
    return names


def named_tests(text):
    """(number of the line, name) of all in the columns `test`; `.Name` goes on from the one before."""
    column = None
    for number, line in enumerate(text.splitlines(), 1):
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)]
        if not line.startswith("|"):
            column = None
        elif column is None:
            column = cells.index("test") if "test" in cells else -1
        elif column > 0:
            before = ""
            # What stands in parentheses explains.
            for name in re.findall(r"`([^`]+)`", re.sub(r"\([^)]*\)", "", cells[column])):
                if name.startswith("-"):
                    continue  # A flag of the compiler.
                before = before.rpartition(".")[0] + name if name.startswith(".") else name
                yield number, before


def missing(text, names):
    def exists(name):
        return ((ROOT / name).exists() or name.removesuffix(".py") in names
                or ("*" in name and bool(fnmatch.filter(names, name))))
    return [f"tests/README.md:{number}: there is no test {name}"
            for number, name in named_tests(text) if not exists(name)]


class PromisesTest(unittest.TestCase):

    def test_all_tests_that_are_named_exist(self):
        text = (TESTS / "README.md").read_text()
        self.assertGreater(len(list(named_tests(text))), 300)
        found = missing(text, known_names())
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_names_that_do_not_exist_are_found(self):
        names = cpp_names("TEST(One, IsA) {}\nTEST_P(Many,\n       AreB) {}\n"
                          "INSTANTIATE_TEST_SUITE_P(All, Many, Values(1));")
        names |= python_names("test_x", "class AnyTest:\n    def test_y(self): pass")
        table = "| promise | test | seen to fail |\n|---|---|---|\n| a | %s | `None.` |\n"
        for right in ("`One.IsA`", "`One.*`", "`All/Many.AreB`; `Many.Are*`", "`test_x.AnyTest`",
                      "`test_x.AnyTest.test_y`", "`test_y`", "`test_x.py`", "`One.IsA`, `.*A`",
                      "`scripts/check.sh`", "`-fno-flag`", "`One.*` (`moved`)"):
            self.assertEqual(missing(table % right, names), [])
        for wrong in ("`One.IsB`", "`One.B*`", "`Most/Many.AreB`", "`One.IsA`, `.IsB`", "`test_z`",
                      "`test_x.OtherTest`", "`scripts/none.sh`"):
            self.assertEqual(len(missing(table % wrong, names)), 1, wrong)


if __name__ == "__main__":
    unittest.main()
