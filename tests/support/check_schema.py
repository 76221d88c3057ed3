#!/usr/bin/env python3
"""usage: check_schema.py LIBFRACAS SCHEMA FILE...

Every FILE that fracas reads is valid by the schema: it refuses nothing that the program takes. Typical mistakes are refused by
both, at the same line."""
import ctypes
import itertools
import json
import os
import re
import sys
import tempfile

import jsonschema
import yaml

library_path, schema_path, *files = sys.argv[1:]
library = ctypes.CDLL(library_path)
library.fracas_error.restype = ctypes.c_char_p
schema = json.load(open(schema_path))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)


def read(path):
    """The messages of the program about a file, by libfracas, and their lines; "" if it reads it."""
    campaign = ctypes.c_void_p()
    if not library.fracas_campaign_open(os.fsencode(path), ctypes.byref(campaign)):
        library.fracas_campaign_close(campaign)
        return "", []
    said = library.fracas_error().decode(errors="replace")
    lines = [int(line) for line in re.findall(r"^[^\n]*:(\d+):\d+: ", said, re.M)]
    return (said, lines) if lines else ("", [])


def line_of(text, path, unknown):
    """Line of the value, or of the unknown key in it, at a path of keys and numbers."""
    node = yaml.compose(text)
    for part in path:
        if isinstance(node, yaml.SequenceNode):
            node = node.value[part]
        else:
            node = next(value for key, value in node.value if key.value == part)
    if unknown:
        node = next(key for key, _ in node.value if key.value == unknown)
    return node.start_mark.line + 1


taken = refused = 0
for path in files:
    try:
        text = open(path, encoding="utf-8").read()
        document = yaml.safe_load(text)
    except (yaml.YAMLError, UnicodeDecodeError, ValueError):
        continue
    message, _ = read(path)
    errors = [error.message for error in validator.iter_errors(document)]
    if not message:
        taken += 1
        assert not errors, (path, errors[:3])
    refused += bool(message and errors)
print(f"{taken} files that fracas reads are valid, {refused} are refused by both")
assert taken > 10

plain = """name: test
seed: 7
model: bar
geometry:
  ends: periodic
  length: 50 mm
mesh:
  elements: 100
material:
  young: 275 GPa
  density: 2750 kg/m3
cohesive:
  law: nitsche
  fracture_energy: 100 J/m2
strength:
  distribution: uniform
  minimum: 299 MPa
  maximum: 301 MPa
loading:
  rate: 1e4 1/s
time:
  stop: quiet
  end: 500 ns
  quiet: 100 ns
replicas: 3
sweep:
  - loading.rate: [1e4 1/s, 2e4 1/s]
"""
mistakes = [("model: bar", "modell: bar"), ("model: bar", "model: beam"), ("  ends: periodic", "  endz: periodic"), ("  ends: periodic", "  ends: open"),
            ("  length: 50 mm", "  lenght: held"),
            ("  elements: 100", "  elements: -1"), ("  elements: 100", "  elements: [3]"), ("  young: 275 GPa", "  yong: 275 GPa"),
            ("  density: 2750 kg/m3", "  density: 0"), ("  law: nitsche", "  law: nitsch"), ("  distribution: uniform", "  distribution: unform"),
            ("  stop: quiet", "  stop: never"), ("replicas: 3", "replicas: 0"), ("  - loading.rate:", "  - loading.rat:"),
            ("replicas: 3", "random_numbers: alike\nreplicas: 3")]
assert not list(validator.iter_errors(yaml.safe_load(plain)))


def check(file, pairs):
    """Program and schema refuse the plain campaign with these mistakes, at the same lines and no other."""
    text = plain
    for right, wrong in pairs:
        assert text.count(right) == 1, right
        text = text.replace(right, wrong)
    file.seek(0)
    file.truncate()
    file.write(text)
    file.flush()
    message, told = read(file.name)
    assert message, pairs
    errors = list(validator.iter_errors(yaml.safe_load(text)))
    lines = set()
    for error in errors:
        if "propertyNames" in error.schema_path:
            lines.add(line_of(text, error.absolute_path, error.instance))
            continue
        unknown = re.findall(r"'([^']*)'[^'(]*(?=.*unexpected)", error.message)
        lines.update(line_of(text, error.absolute_path, key) for key in unknown or [None])
    assert set(told) == lines, (pairs, message, told, lines, [error.message for error in errors])
    return len(told)


with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
    for mistake in mistakes:
        check(file, [mistake])
    print(f"{len(mistakes)} mistakes are refused at the same line")
    # Any of them together, each line of the file with one: neither stops at the first, and nothing follows from another.
    apart = {right: (right, wrong) for right, wrong in mistakes}
    together = list(itertools.combinations(apart.values(), 2)) + [list(apart.values())]
    print(f"{len(together)} files with several, {sum(check(file, pairs) for pairs in together)} in all, too")
