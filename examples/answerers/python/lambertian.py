#!/usr/bin/env python3
"""A Lambertian BSDF that answers plumbline (docs/protocol.md): plumbline verify --exec 'python3 lambertian.py'

With --faulty it states the pdf of uniform directions, not of those that it samples."""
import io
import json
import sys

import numpy as np

FAULTY = "--faulty" in sys.argv
ALBEDO = 0.8


def pdf(wo, wi):
    """[1/sr]"""
    density = 0.5 if FAULTY else wi[:, 2]
    return np.where((wo[:, 2] > 0) & (wi[:, 2] > 0), density / np.pi, 0)


def evaluate(wo, wi):
    """f [1/sr], without the cosine"""
    return np.where((wo[:, 2] > 0) & (wi[:, 2] > 0), ALBEDO / np.pi, 0)


def sample(wo, u):
    r, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    wi = np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[:, 0])], axis=1)
    density = pdf(wo, wi)
    accepted = density > 0
    weight = evaluate(wo, wi) * wi[:, 2] / np.where(accepted, density, 1)
    return wi, density, weight, accepted


def read_array(count, columns):
    sys.stdin.buffer.read(128)  # the header: what it says is known
    data = sys.stdin.buffer.read(8 * count * columns)
    return np.frombuffer(data, "<f8").reshape(count, columns)


def write_array(array):
    npy = io.BytesIO()  # numpy.save wants to seek, which a pipe cannot
    np.save(npy, array)
    sys.stdout.buffer.write(npy.getbuffer())


print(json.dumps({"protocol": "plumbline/1", "name": "lambertian", "precision": "float64",
                  "numbers": 2, "functions": ["sample", "pdf", "eval"]}), flush=True)
for line in sys.stdin.buffer:
    query = json.loads(line)
    wo = read_array(query["count"], 3)
    given = read_array(query["count"], 2 if query["kind"] == "sample" else 3)
    answer = {"sample": sample, "pdf": pdf, "eval": evaluate}[query["kind"]](wo, given)
    sys.stdout.buffer.write(line)  # an answer begins with the line of its query
    for array in answer if query["kind"] == "sample" else [answer]:
        write_array(array)
    sys.stdout.buffer.flush()
