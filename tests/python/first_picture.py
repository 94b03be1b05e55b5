"""From a built wheel in an empty environment to the first moving picture in a notebook: first_picture.py WHEEL

Two commands and three lines of Python, timed; NumPy is in pip's cache. The environment has a program for notebooks and nothing else;
its installation is not timed. The better of two tries must stay below 10 s.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time
import venv

#: Time allowed (s).
ALLOWED = 10.0
LINES = ["import linkproof\n", 'scenario = linkproof.Scenario.new("slider-crank")\n', "scenario"]


def attempt(wheel, place):
    """Time (s) from the environment for notebooks to the picture."""
    venv.create(place / "environment", with_pip=True)
    cell = {"cell_type": "code", "id": "first", "metadata": {}, "source": LINES, "execution_count": None, "outputs": []}
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    book = place / "first.ipynb"
    book.write_text(json.dumps({"cells": [cell], "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}))
    programs = place / "environment/bin"
    install = [programs / "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*install, "nbclient", "ipykernel"], check=True)
    began = time.perf_counter()
    subprocess.run([*install, wheel], check=True)
    installed = time.perf_counter()
    subprocess.run([programs / "jupyter", "execute", "--inplace", book], check=True, capture_output=True)
    took = time.perf_counter() - began
    [output] = json.loads(book.read_text())["cells"][0]["outputs"]
    assert "data:image/webp;base64," in "".join(output["data"]["text/html"]), output
    print(f"first moving picture after {took:.1f} s: {installed - began:.1f} s to install, the rest for the notebook")
    return took


def main():
    wheel = pathlib.Path(sys.argv[1]).resolve()
    for _ in range(2):
        with tempfile.TemporaryDirectory() as place:
            if attempt(wheel, pathlib.Path(place)) < ALLOWED:
                return
    sys.exit(f"both tries took longer than {ALLOWED} s")


main()
