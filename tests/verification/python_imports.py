"""The Python modules of share/ import one another without a circle, and in the direction the layout draws:
scripts → microslip.report → microslip.results → microslip.plots → the readers of files.

Imports are read from the source, those within functions included: a circle that is hidden in a function is one.

usage: python_imports.py SOURCE_FOLDER
"""
import ast
import os
import sys
import tempfile
import unittest

SHARE = os.path.join(sys.argv.pop(1), "share")


def modules_in(folder):
    """Path of every module below a folder by its dotted name; a package has the name of its folder."""
    found = {}
    for parent, _, files in os.walk(folder):
        parts = os.path.relpath(parent, folder).split(os.sep)
        for file in files:
            stem, extension = os.path.splitext(file)
            if extension == ".py":
                words = [word for word in parts + [stem] if word not in (".", "__init__")]
                found[".".join(words)] = os.path.join(parent, file)
    return found


def names_imported(path, module):
    """Dotted names an import of a file may mean: `from a import b` is a.b, or the name b in a."""
    with open(path, encoding="utf-8") as file:
        tree = ast.parse(file.read(), path)
    package = module if os.path.basename(path) == "__init__.py" else module.rpartition(".")[0]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ([alias.name] for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[:len(package.split(".")) - node.level + 1] if node.level else []
            base = ".".join(above + ([node.module] if node.module else []))
            yield from ([f"{base}.{alias.name}", base] for alias in node.names)


def imports_of(modules):
    """The modules each module imports, of those given."""
    return {module: {next(name for name in names if name in modules)
                     for names in names_imported(path, module) if any(name in modules for name in names)}
            for module, path in modules.items()}


def circle_in(imports):
    """The modules along a circle, the first again at the end; None without one."""
    done, way = set(), []

    def visit(module):
        if module in way:
            return way[way.index(module):] + [module]
        if module in done:
            return None
        way.append(module)
        circle = next(filter(None, map(visit, sorted(imports[module]))), None)
        way.pop()
        done.add(module)
        return circle

    return next(filter(None, map(visit, sorted(imports))), None)


class Imports(unittest.TestCase):
    def setUp(self):
        self.scripts = modules_in(os.path.join(SHARE, "scripts"))
        self.package = modules_in(os.path.join(SHARE, "python"))

    def test_no_circle(self):
        imports = imports_of({**self.scripts, **self.package})
        self.assertIn("microslip.plots.style", imports["microslip.plots.curves"])  # imports are seen
        circle = circle_in(imports)
        self.assertIsNone(circle, " → ".join(circle or []))

    def test_nothing_imports_a_script(self):
        for module, imported in imports_of({**self.scripts, **self.package}).items():
            self.assertFalse(imported & set(self.scripts), module)

    def test_reading_knows_no_drawing(self):
        above = ("microslip.plots", "microslip.results", "microslip.report")
        for module, imported in imports_of(self.package).items():
            if not module.startswith(above):
                self.assertFalse([name for name in imported if name.startswith("microslip.plots")], module)

    def test_plots_know_nothing_above_them(self):
        above = ("microslip.results", "microslip.running", "microslip.report")
        for module, imported in imports_of(self.package).items():
            if module.startswith("microslip.plots"):
                self.assertFalse([name for name in imported if name.startswith(above)], module)

    def test_a_circle_would_be_found(self):
        texts = {"p/__init__.py": "", "p/a.py": "from p import b\n", "p/b.py": "import os\nfrom .q.c import f\n",
                 "p/q/__init__.py": "", "p/q/c.py": "def f():\n    import p.a\n", "p/d.py": "from p.a import g\n"}
        with tempfile.TemporaryDirectory() as folder:
            for name, text in texts.items():
                path = os.path.join(folder, name)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            imports = imports_of(modules_in(folder))
            self.assertEqual(circle_in(imports), ["p.a", "p.b", "p.q.c", "p.a"])
            del imports["p.d"], imports["p.q.c"]
            self.assertIsNone(circle_in({module: imported & set(imports) for module, imported in imports.items()}))


if __name__ == "__main__":
    unittest.main(verbosity=2)
