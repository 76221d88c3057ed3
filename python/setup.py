"""The version is the program's, from project() in CMakeLists.txt."""
import re
from pathlib import Path

from setuptools import setup

text = (Path(__file__).resolve().parent.parent / "CMakeLists.txt").read_text()
setup(version=re.search(r"^project\(fracas VERSION ([\d.]+)", text, re.M)[1])
