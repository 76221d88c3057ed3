"""An oracle for plates: continuous linear triangles, cohesive edges put in where the stress reaches the strength.

usage: continuous_plate.py STUDY [--realization R] [--step PART] [--times T,T,...]

Reads mesh, strengths and parameters of a stored membrane of linear triangles whose edges are held. Corners of elements at a vertex
move as one while edges without a crack join them; an edge cracks as a whole where the mean stress of its two elements reaches its
strength, and then has Camacho and Ortiz' linear law at two Gauss points, from the strength on. Nothing is shared with fracas but the
study. Prints, a line a time: time [s], the energy that flight and edges have given, elastic and dissipated energy [J], fragments, error
of the sum [J]; then the same of the study, but the error.
"""
import argparse
import os

import h5py
import numpy as np


class Study:
    """A realization: nodes, triangles, interfaces with their strengths, held edges, and what the study has of its history."""

    def __init__(self, folder, realization):
        with h5py.File(os.path.join(folder, "study.h5"), "r") as file:
            point = int(file["realization/point"][realization])
            of = lambda group, i: slice(*(int(o) for o in file[group + "offset"][i:i + 2]))
            self.value = {name: file["point/" + name][point] for name in file["point"]}
            nodes, elements = of("mesh/node_", point), of("mesh/element_", point)
            interfaces, borders = of("mesh/interface_", point), of("mesh/border_", point)
            self.x = file["mesh/node_position"][nodes][:, :2]
            self.corner = file["mesh/element_node"][elements][:, :3]
            self.pair = file["mesh/interface_element"][interfaces]
            self.ends = file["mesh/interface_node"][interfaces][:, :2]
            self.border = file["mesh/border_element"][borders], file["mesh/border_node"][borders][:, :2]
            rows = of("interface/", realization)
            self.strength = file["interface/strength"][rows]
            rows = of("history/", realization)
            self.history = {name: file["history/" + name][rows] for name in file["history"] if name != "offset"}
        start = self.history["kinetic"][0] + self.history["elastic"][0]
        self.history["given"] = start + self.history["work"] - self.history["kinetic"]

    def at(self, time, name):
        return float(np.interp(time, self.history["time"], self.history[name]))


class Plate:
    """The continuous plate. Arrays of corners are (3 elements, 2): corner a of element e is row 3 e + a."""

    def __init__(self, study, part):
        value = study.value
        young, nu = value["material.young"], value["material.poisson"]
        self.thickness, density = value["geometry.thickness"], value["material.density"]
        self.opening, rate = value["cohesive.critical_opening"], value["loading.rate"]
        x, corner = study.x, study.corner
        a, b, c = (x[corner[:, k]] for k in range(3))
        self.area = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
        assert (self.area > 0).all()
        # Gradients of the three hat functions: (elements, 3, 2).
        turned = lambda d: np.stack([d[:, 1], -d[:, 0]], axis=1)
        self.gradient = np.stack([turned(b - c), turned(c - a), turned(a - b)], axis=1) / (2 * self.area)[:, None, None]
        self.plane = young / (1 - nu * nu), nu, (1 - nu) / 2
        self.mass = np.repeat(density * self.thickness * self.area / 3, 3)

        # Interfaces: the corners of both elements at both ends, the normal out of the first, the length.
        def find(element, node):
            same = corner[element] == node[:, None]
            assert same.any(axis=1).all()
            return 3 * element + np.argmax(same, axis=1)

        self.first = np.stack([find(study.pair[:, 0], study.ends[:, k]) for k in (0, 1)], axis=1)
        self.second = np.stack([find(study.pair[:, 1], study.ends[:, k]) for k in (0, 1)], axis=1)
        along = x[study.ends[:, 1]] - x[study.ends[:, 0]]
        self.length = np.hypot(*along.T)
        self.tangent = along / self.length[:, None]
        self.normal = np.stack([self.tangent[:, 1], -self.tangent[:, 0]], axis=1)
        middle = lambda element: x[corner[element]].mean(axis=1)
        assert (np.einsum("ij,ij->i", middle(study.pair[:, 1]) - middle(study.pair[:, 0]), self.normal) > 0).all()
        self.pair, self.strength = study.pair, study.strength

        n = len(self.mass)
        self.held = np.zeros(n, bool)
        for k in (0, 1):
            self.held[find(study.border[0], study.border[1][:, k])] = True
        self.u = np.zeros((n, 2))
        self.v = rate * x[corner.ravel()]
        self.cracked = np.zeros(len(self.strength), bool)
        _, at, self.vertex = np.unique(corner.ravel(), return_index=True, return_inverse=True)
        self.group = at[self.vertex]  # a group of corners has the number of one of them
        self.work = 0.0
        # Of cracked edges, in the order of their cracks; at two Gauss points: damage D, traction of the onset.
        self.crack = np.zeros(0, int)
        self.damage, self.onset = np.zeros((0, 2)), np.zeros((0, 2))
        size = self.area[self.pair].min(axis=1) / self.length
        self.contact = young / (1 - nu * nu) / size * 10
        height = 2 * self.area / np.sqrt(np.maximum.reduce([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))]))
        self.step = part * (height / np.sqrt(young / (density * (1 - nu * nu)))).min()
        self.force()

    def stresses(self):
        """(elements, 3): xx, yy, xy."""
        u = self.u.reshape(-1, 3, 2)
        e = np.einsum("eai,eaj->eij", u, self.gradient)
        p, q, s = self.plane
        return np.stack([p * (e[:, 0, 0] + q * e[:, 1, 1]), p * (q * e[:, 0, 0] + e[:, 1, 1]), p * s * (e[:, 0, 1] + e[:, 1, 0])],
                        axis=1), e

    def regroup(self, cracked):
        """Corners at the ends of the edges that crack: which of them are still joined by edges without a crack."""
        vertices = np.unique(self.vertex[self.first[cracked]])
        touched = np.isin(self.vertex, vertices)
        self.group[touched] = np.flatnonzero(touched)  # each for itself, by its own number
        first, second = self.first[~self.cracked].ravel(), self.second[~self.cracked].ravel()
        near = touched[first]
        first, second = first[near], second[near]
        while True:
            least = np.minimum(self.group[first], self.group[second])
            before = self.group.copy()
            np.minimum.at(self.group, first, least)
            np.minimum.at(self.group, second, least)
            if (before == self.group).all():
                return

    def force(self):
        """Accelerations at u, after the cracks that u asks for; the energies."""
        stress, strain = self.stresses()
        sxx, syy, sxy = (self.thickness * self.area * stress[:, k] for k in range(3))
        g = self.gradient
        f = np.stack([-(sxx[:, None] * g[:, :, 0] + sxy[:, None] * g[:, :, 1]),
                      -(sxy[:, None] * g[:, :, 0] + syy[:, None] * g[:, :, 1])], axis=2).reshape(-1, 2)
        self.elastic = 0.5 * float((sxx * strain[:, 0, 0] + syy * strain[:, 1, 1] + sxy * (strain[:, 0, 1] + strain[:, 1, 0])).sum())

        m = stress[self.pair].mean(axis=1)
        n = self.normal
        traction = np.stack([m[:, 0] * n[:, 0] + m[:, 2] * n[:, 1], m[:, 2] * n[:, 0] + m[:, 1] * n[:, 1]], axis=1)
        normal, shear = np.einsum("ij,ij->i", traction, n), np.einsum("ij,ij->i", traction, self.tangent)
        effective = np.where(normal >= 0, np.hypot(normal, shear), np.abs(shear))
        new = np.flatnonzero((effective > self.strength) & ~self.cracked)
        if len(new):
            self.cracked[new] = True
            self.crack = np.concatenate([self.crack, new])
            self.damage = np.concatenate([self.damage, np.zeros((len(new), 2))])
            late = self.strength[new] / effective[new]  # what the step went beyond the strength is taken off
            self.onset = np.concatenate([self.onset, np.stack([late * normal[new], late * shear[new]], axis=1)])
            self.regroup(new)

        i = self.crack
        peak = np.hypot(np.maximum(0, self.onset[:, 0]), self.onset[:, 1])
        pressed = stored = 0.0
        rows, forces = [], []
        for k, at in enumerate(((1 - 3 ** -0.5) / 2, (1 + 3 ** -0.5) / 2)):
            weight = self.thickness * self.length[i] / 2
            jump = (1 - at) * (self.u[self.second[i, 0]] - self.u[self.first[i, 0]]) + at * (self.u[self.second[i, 1]] - self.u[self.first[i, 1]])
            dn, dt = np.einsum("ij,ij->i", jump, n[i]), np.einsum("ij,ij->i", jump, self.tangent[i])
            open_ = np.hypot(np.maximum(0, dn), dt)
            now = np.minimum(1, open_ / self.opening)
            d = self.damage[:, k] = np.maximum(self.damage[:, k], now)
            loads = d == now
            secant = peak * (1 - d) / np.where(d > 0, d * self.opening, 1)
            secant = np.where(loads, secant, np.minimum(secant, self.contact[i]))  # a crack that has hardly opened is no stiffer
            tn = np.where(d > 0, secant * np.maximum(0, dn), np.maximum(0, self.onset[:, 0]))
            tt = np.where(d > 0, secant * dt, self.onset[:, 1])
            press = self.contact[i] * np.minimum(0, dn)
            press = np.where(d > 0, press, np.where(self.onset[:, 0] < 0, self.onset[:, 0], press))
            stored += float((weight * np.where(d > 0, secant * open_ ** 2 / 2, 0)).sum())
            pressed += float((weight * self.contact[i] * np.minimum(0, dn) ** 2 / 2).sum())
            t = weight[:, None] * ((tn + press)[:, None] * n[i] + tt[:, None] * self.tangent[i])
            for end, share in ((0, 1 - at), (1, at)):
                rows += [self.first[i, end], self.second[i, end]]
                forces += [share * t, -share * t]
        rows, forces = np.concatenate(rows), np.concatenate(forces)
        f += np.stack([np.bincount(rows, forces[:, k], len(f)) for k in (0, 1)], axis=1)
        self.cohesive = stored + pressed
        self.dissipated = float((self.thickness * self.length[i] / 2 * peak * self.opening / 2 * self.damage.sum(axis=1)).sum())

        count = len(self.mass)
        mass = np.bincount(self.group, self.mass, count)
        held = np.bincount(self.group, self.held, count) > 0
        sums = [np.bincount(self.group, f[:, k], count) for k in (0, 1)]
        self.power = -float(sum((held * s * self.v[:, k]).sum() for k, s in enumerate(sums)))
        with np.errstate(invalid="ignore", divide="ignore"):
            self.a = np.stack([np.where(held, 0, s / mass) for s in sums], axis=1)[self.group]

    def advance(self):
        self.v += self.step / 2 * self.a
        self.u += self.step * self.v
        before = self.power
        self.force()
        self.work += self.step / 2 * (before + self.power)
        self.v += self.step / 2 * self.a

    def kinetic(self):
        return 0.5 * float((self.mass[:, None] * self.v ** 2).sum())

    def fragments(self):
        """Sets of elements that edges not broken at both Gauss points join."""
        broken = np.zeros(len(self.strength), bool)
        broken[self.crack] = (self.damage >= 1).all(axis=1)
        label = np.arange(len(self.area))
        first, second = self.pair[~broken].T
        while True:
            least = np.minimum(label[first], label[second])
            before = label.copy()
            np.minimum.at(label, first, least)
            np.minimum.at(label, second, least)
            label = label[label]
            if (before == label).all():
                return len(np.unique(label))


def run(study, part, times):
    """A row a time: time, energy that flight and edges have given, elastic, dissipated, fragments, error of the sum."""
    plate = Plate(study, part)
    start, now, rows = plate.kinetic() + plate.elastic, 0.0, []
    for until in times:
        while now < until:
            plate.advance()
            now += plate.step
        kinetic = plate.kinetic()
        error = kinetic + plate.elastic + plate.cohesive + plate.dissipated - plate.work - start
        rows.append((now, start + plate.work - kinetic, plate.elastic, plate.dissipated, plate.fragments(), error))
    return rows


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("study")
    parser.add_argument("--realization", type=int, default=0)
    parser.add_argument("--step", type=float, default=0.05)
    parser.add_argument("--times", default="50e-9,100e-9,200e-9,400e-9,600e-9")
    arguments = parser.parse_args()
    study = Study(arguments.study, arguments.realization)
    for row in run(study, arguments.step, [float(t) for t in arguments.times.split(",")]):
        ours = [study.at(row[0], name) for name in ("given", "elastic", "dissipated", "fragments")]
        print(" ".join("%.5g" % value for value in row), "| fracas:", " ".join("%.5g" % value for value in ours), flush=True)


if __name__ == "__main__":
    main()
