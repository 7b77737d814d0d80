# SPDX-License-Identifier: MIT
"""The package as a whole: stubs, docstrings, the README's program and the example."""
import ast
import inspect
import os
import pathlib
import re
import subprocess
import sys
import unittest

import trajlo
from trajlo import _processor, _trajlo
from support import BUILD, ROOT, FolderTest

PACKAGE = ROOT / "apps" / "python"


def public(names):
    return {name for name in names if not name.startswith("_")}


class StubTest(unittest.TestCase):

    def setUp(self):
        self.stub = ast.parse((PACKAGE / "trajlo" / "_trajlo.pyi").read_text())

    def test_the_stub_has_what_the_module_has(self):
        names = set()
        for node in self.stub.body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                names.add(node.name)
            elif isinstance(node, ast.AnnAssign):
                names.add(node.target.id)
        self.assertEqual(names, public(dir(_trajlo)))

    def test_its_classes_have_the_same_members(self):
        for node in self.stub.body:
            if not isinstance(node, ast.ClassDef):
                continue
            members = {member.name for member in node.body}
            self.assertEqual(public(members), public(dir(getattr(_trajlo, node.name))), node.name)

    def test_its_functions_have_the_same_arguments(self):
        def check(node, function):
            first = (function.__doc__ or "").splitlines()[0]
            if not first.startswith(f"{node.name}("):
                return
            arguments = [a.arg for a in node.args.args + node.args.kwonlyargs if a.arg != "self"]
            found = [n for n in re.findall(r"(\w+): ", first) if n != "self"]
            self.assertEqual(arguments, found, first)

        for node in self.stub.body:
            if isinstance(node, ast.FunctionDef):
                check(node, getattr(_trajlo, node.name))
            elif isinstance(node, ast.ClassDef):
                for member in node.body:
                    if isinstance(member, ast.FunctionDef) and not member.decorator_list:
                        check(member, getattr(getattr(_trajlo, node.name), member.name))

    def test_it_is_marked_as_typed(self):
        self.assertTrue((pathlib.Path(trajlo.__file__).parent / "py.typed").exists())


class InstallTest(FolderTest):

    def test_it_goes_into_a_wheel_and_into_no_prefix(self):
        def installed(*more):
            prefix = self.folder / "-".join(("prefix", *more))
            subprocess.run(["cmake", f"-DCMAKE_INSTALL_PREFIX={prefix}", *more, "-P",
                            BUILD / "apps" / "python" / "cmake_install.cmake"],
                           check=True, capture_output=True)
            return {str(path.relative_to(prefix)) for path in prefix.rglob("*") if path.is_file()}

        self.assertEqual(installed(), set())
        wheel = installed("-DCMAKE_INSTALL_COMPONENT=python")
        self.assertLessEqual({"trajlo/__init__.py", "trajlo/_build.py", "trajlo/py.typed",
                              "trajlo/config/ouster.yaml"}, wheel)


class ProcessorTest(FolderTest):

    def test_an_older_cpu_gets_a_message(self):
        cpuinfo = self.folder / "cpuinfo"
        cpuinfo.write_text("processor : 0\nflags : fpu sse2 avx2 fma\n")
        with self.assertRaisesRegex(ImportError, "x86-64-v3, and this CPU has no bmi2;"):
            _processor.require("x86-64-v3", cpuinfo)
        _processor.require("", cpuinfo)
        cpuinfo.write_text("processor : 0\nflags : fpu sse2 avx2 bmi2 fma\n")
        _processor.require("x86-64-v3", cpuinfo)
        _processor.require("x86-64-v3", self.folder / "missing")


class DocumentationTest(FolderTest):

    def test_everything_public_is_explained(self):
        for name in trajlo.__all__:
            thing = getattr(trajlo, name)
            self.assertTrue(inspect.getdoc(thing), name)
            if not inspect.isclass(thing) or issubclass(thing, (Exception, Warning)):
                continue
            for member in public(vars(thing)):
                self.assertTrue(inspect.getdoc(getattr(thing, member)), f"{name}.{member}")

    def test_errors_are_of_their_classes(self):
        for name in ("ConfigError", "UsageError", "InputError", "EvaluationError"):
            self.assertTrue(issubclass(getattr(trajlo, name), ValueError), name)
        self.assertTrue(issubclass(trajlo.OutputError, OSError))
        self.assertTrue(issubclass(trajlo.StateError, RuntimeError))
        for name in trajlo.errors.__all__:
            base = trajlo.TrajloWarning if name.endswith("Warning") else trajlo.Error
            self.assertTrue(issubclass(getattr(trajlo, name), base), name)

    def test_the_program_of_the_readme_runs(self):
        readme = (PACKAGE / "README.md").read_text()
        program = re.search(r"```python\n(.*?)```", readme, re.S).group(1)
        # What a reader has: a recording and its truth.
        simulation = trajlo.simulate("hall_os1_16", duration_s=4.0)
        simulation.truth.save_tum(self.folder / "truth.tum")
        program = program.replace('trajlo.open("flight.bag")', "SIMULATION")
        self.assertIn("SIMULATION", program)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        exec(compile(program, "README.md", "exec"), {"SIMULATION": simulation})
        self.assertTrue((self.folder / "trajectory.tum").exists())

    def test_the_example_draws(self):
        figure = self.folder / "figure.png"
        done = subprocess.run(
            [sys.executable, "-B", PACKAGE / "examples" / "draw_simulated_flight.py", figure,
             "--seconds=2"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(figure.read_bytes().startswith(b"\x89PNG"))
        self.assertIn("RMSE", done.stdout)


if __name__ == "__main__":
    unittest.main()
