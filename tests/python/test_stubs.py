# SPDX-License-Identifier: MIT
"""The type stubs of the module have its names and signatures.

Usage: python3 test_stubs.py [unittest options], with the module on PYTHONPATH.
"""

import ast
import inspect
import os
import re
import unittest

import lsys

STUBS = os.path.join(os.path.dirname(lsys.__file__), "__init__.pyi")


def stub_parameters(function):
    """Names of the parameters of a function of the stubs, with their kind and default."""
    arguments = function.args
    positional = [argument.arg for argument in arguments.posonlyargs + arguments.args]
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    rows = [(name, "positional", value) for name, value in zip(positional, defaults)]
    rows += [(argument.arg, "keyword", value)
             for argument, value in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    if arguments.kwarg:
        rows.append((arguments.kwarg.arg, "rest", None))
    return [(name, kind, None if value is None else ast.literal_eval(value) if kind != "rest" else None)
            for name, kind, value in rows]


def python_parameters(function):
    """Names of the parameters of a function of Python, with their kind and default."""
    kinds = {inspect.Parameter.POSITIONAL_OR_KEYWORD: "positional",
             inspect.Parameter.KEYWORD_ONLY: "keyword", inspect.Parameter.VAR_KEYWORD: "rest"}
    return [(parameter.name, kinds[parameter.kind],
             None if parameter.default is inspect.Parameter.empty else parameter.default)
            for parameter in inspect.signature(function).parameters.values()]


def native_parameters(function):
    """Names, kinds and defaults of the parameters of a pybind11 function, whose docstring begins with its signature."""
    inside = re.match(r"\w+\((.*)\)", function.__doc__.split("\n")[0].rsplit(" -> ", 1)[0]).group(1)
    rows = []
    for part in re.split(r", (?=[*\w]+(?::| = |$))", inside):
        if part.startswith("**"):
            rows.append((part[2:], "rest", None))
            continue
        name, _, value = part.partition(" = ")
        default = ast.literal_eval(value) if value else None
        rows.append((name.partition(":")[0], "positional", default))
    return rows


def first_names(rows):
    """Renames `arg0` to `self`, because pybind11 uses both names for the object."""
    return [("self" if name == "arg0" else name, kind, value) for name, kind, value in rows]


class Stubs(unittest.TestCase):
    def setUp(self):
        with open(STUBS, encoding="utf-8") as file:
            self.tree = ast.parse(file.read())
        self.classes = {node.name: node for node in self.tree.body if isinstance(node, ast.ClassDef)}
        self.functions = {node.name: node for node in self.tree.body
                          if isinstance(node, ast.FunctionDef)}

    def test_names(self):
        named = set(self.classes) | set(self.functions)
        for node in self.tree.body:
            if isinstance(node, ast.AnnAssign):
                named.add(node.target.id)
            elif isinstance(node, ast.ImportFrom) and node.module == "errors":
                named |= {alias.asname for alias in node.names}
        self.assertEqual(named, set(lsys.__all__))

    def test_classes(self):
        compared = 0
        for name, node in self.classes.items():
            real = getattr(lsys, name)
            members = {member.name: member for member in node.body
                       if isinstance(member, ast.FunctionDef)}
            public = {key for key in vars(real) if not key.startswith("_")}
            with self.subTest(name):
                self.assertEqual({key for key in members if not key.startswith("_")}, public)
            for key, member in members.items():
                decorators = [getattr(each, "id", "") for each in member.decorator_list]
                value = inspect.getattr_static(real, key)
                compared += 1
                with self.subTest(f"{name}.{key}"):
                    self.assertEqual("property" in decorators, isinstance(value, property))
                    if "property" in decorators:
                        continue
                    function = getattr(real, key)
                    if inspect.isfunction(function):
                        expected = python_parameters(function)
                        self.assertEqual([row[1:] for row in stub_parameters(member)][:1],
                                         [row[1:] for row in expected][:1])
                        self.assertEqual(stub_parameters(member)[1:], expected[1:])
                    elif not key.startswith("__"):
                        self.assertEqual(stub_parameters(member),
                                         first_names(native_parameters(function)))
        self.assertGreater(compared, 100)

    def test_functions(self):
        for name, node in self.functions.items():
            self.assertEqual(stub_parameters(node), python_parameters(getattr(lsys, name)))

    def test_marker(self):
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(STUBS), "py.typed")))


if __name__ == "__main__":
    unittest.main()
