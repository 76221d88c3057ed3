"""The tables of a study in pandas: fracas export STUDY; python3 tables_with_pandas.py

Prints the mean size by rate from the points and again from the fragments, quantiles of normalised sizes, a survival curve, and
some numbers of all points. Needs pandas. A test runs it.
"""

import json
import pandas as pd

pd.options.display.float_format = "{:.4g}".format
folder = "STUDY/export/"
with open(folder + "datapackage.json") as file:
    package = json.load(file)
kind = {"integer": "Int64", "number": "float64", "string": "string"}  # Int64: whole numbers, some of which may be missing
tables, unit = {}, {}
for resource in package["resources"]:
    fields = resource["schema"]["fields"]
    tables[resource["name"]] = pd.read_csv(folder + resource["path"], dtype={field["name"]: kind[field["type"]] for field in fields},
                                           keep_default_na=False, na_values=resource["schema"]["missingValues"])
    unit[resource["name"]] = {field["name"]: field.get("unit", "") for field in fields}

points, realizations, fragments = tables["points"], tables["realizations"], tables["fragments"]
print(package["campaign"], package["seed"], package["program_version"])
print(len(points), "points,", len(realizations), "realizations,", len(fragments), "fragments")
print("a size is in", unit["fragments"]["size"])
rate = "derived.strain_rate"
by_rate = points[[rate, "size.n", "size.mean", "size.half_width"]].sort_values(rate)
print(by_rate.to_string(index=False))
used = realizations[realizations["outcome"].isin(["FRAGMENTED", "INTACT", "TIME_LIMIT"])]
used = used.merge(points[["point", rate]], on="point", validate="many_to_one")
of_realization = fragments.groupby(["point", "replica"])["size"].mean()
used = used.merge(of_realization, on=["point", "replica"], validate="one_to_one")
mean = used.groupby(rate)["size"].agg(["count", "mean", "sem"])  # sem: standard error of the mean
print(mean)
sizes = fragments.merge(points[["point", rate, "scale.size"]], on="point", validate="many_to_one")
sizes["normalised"] = sizes["size"] / sizes["scale.size"]
print(sizes.groupby(rate)["normalised"].describe(percentiles=[0.1, 0.5, 0.9]))
fastest = sizes[(sizes[rate] == sizes[rate].max()) & (sizes["dust"] == 0)]
count = fastest["size"].value_counts().sort_index()              # sizes are multiples of the element size: many are equal
survival = 1 - (count.cumsum() - count) / count.sum()            # at each size, before it falls
print(survival.head())
statistics = tables["statistics"]
print(statistics[statistics["key"].isin(["count.mean", "count.half_width", "dissipated.mean"])].to_string(index=False))
wide = statistics.pivot(index="point", columns="key", values="value")
