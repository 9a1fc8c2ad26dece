"""Functions of share/python say what they take and give, so that an editor and a type checker know it where they are used.

usage: python_annotations.py SOURCE_FOLDER
"""
import ast
import builtins
import os
import sys
import unittest

PACKAGE = os.path.join(sys.argv.pop(1), "share", "python", "microslip")


def modules():
    for folder, _, names in os.walk(PACKAGE):
        yield from (os.path.join(folder, name) for name in sorted(names) if name.endswith(".py"))


def silent(function):
    """What a function does not say the type of; the receiver of a method needs none."""
    given = function.args
    arguments = [*given.posonlyargs, *given.args, *given.kwonlyargs, *filter(None, (given.vararg, given.kwarg))]
    lacking = [argument.arg for argument in arguments if argument.annotation is None and argument.arg not in ("self", "cls")]
    return lacking + ([] if function.returns else ["what it returns"])


def unknown_names(tree):
    """Names in annotations that the module does not have."""
    known = {*vars(builtins), *(node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store))}
    for node in ast.walk(tree):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            known |= {(alias.asname or alias.name).partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ClassDef):
            known.add(node.name)
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    types = [part for function in functions for part in (function.returns, *(node.annotation for node in ast.walk(function.args)
                                                                            if isinstance(node, ast.arg))) if part]
    return {node.id for part in types for node in ast.walk(part) if isinstance(node, ast.Name)} - known


class Annotations(unittest.TestCase):
    def test_every_function_has_them(self):
        n_functions = 0
        for path in modules():
            with open(path, encoding="utf-8") as file:
                tree = ast.parse(file.read(), path)
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef):
                    n_functions += 1
                    self.assertEqual(silent(node), [], f"{os.path.relpath(path, PACKAGE)}:{node.lineno} {node.name}")
            self.assertEqual(unknown_names(tree), set(), os.path.relpath(path, PACKAGE))
        self.assertGreater(n_functions, 450)

    def test_what_lacks_is_seen(self):
        tree = ast.parse("def f(a, *, b: Nothing = 1, **c) -> int:\n    pass\ndef g(self):\n    pass\n")
        self.assertEqual([silent(node) for node in tree.body], [["a", "c"], ["what it returns"]])
        self.assertEqual(unknown_names(tree), {"Nothing"})


if __name__ == "__main__":
    unittest.main(verbosity=2)
