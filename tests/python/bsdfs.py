"""BSDFs as people write them in NumPy: for n directions at once, in whatever dtype comes in."""

import numpy as np

import plumbline

# The suite is about the way between Python and the checks, which are proven elsewhere.
QUICK = plumbline.Effort(
    points=200,
    jacobian_points=100,
    mass_tolerance=0.02,
    evaluations=10_000,
    first_look=4_000,
    samples=4_000,
    finest_bins=64,
    deviation=0.25,
)
ONE_VIEW = dict(
    angles=[30], random_directions=0, back=False, energy_tolerance=0.02, seed=3, effort=QUICK
)


def dot(a, b):
    return np.sum(a * b, axis=-1)


def cosine_direction(u):
    """Directions with density cosθ/π, z up."""
    radius, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    z = np.sqrt(1 - u[:, 0])
    return np.stack([radius * np.cos(phi), radius * np.sin(phi), z], axis=-1).astype(u.dtype)


class Lambert:
    """A diffuse reflection, seen from its front."""

    def __init__(self, albedo=0.5):
        self.albedo = albedo

    def sample(self, wo, u):
        wi = cosine_direction(u)
        weight = np.full(len(u), self.albedo, u.dtype)
        return wi, self.pdf(wo, wi), weight, wo[:, 2] > 0

    def pdf(self, wo, wi):
        above = (wo[:, 2] > 0) & (wi[:, 2] > 0)
        return np.where(above, wi[:, 2] / np.pi, 0).astype(wi.dtype)

    def eval(self, wo, wi):
        above = (wo[:, 2] > 0) & (wi[:, 2] > 0)
        return np.where(above, self.albedo / np.pi, 0).astype(wi.dtype)


class Ggx:
    """A rough mirror without Fresnel, by visible normals.

    Heitz 2018 (JCGT 7:4), Eqs. 1 to 3 and Appendix A; wi and its pdf by the half-vector Jacobian.
    """

    def __init__(self, alpha=0.4):
        self.alpha = alpha

    def lambda_of(self, w):
        tangent2 = np.maximum(0, 1 - w[:, 2] ** 2) / w[:, 2] ** 2
        return (np.sqrt(1 + self.alpha**2 * tangent2) - 1) / 2

    def d(self, h):
        a2 = self.alpha**2
        return a2 / (np.pi * (h[:, 2] ** 2 * (a2 - 1) + 1) ** 2)

    def sample(self, wo, u):
        a = self.alpha
        v = wo * [a, a, 1]
        v /= np.sqrt(dot(v, v))[:, None]
        across = np.stack([-v[:, 1], v[:, 0], np.zeros(len(v))], axis=-1)
        length = np.sqrt(dot(across, across))[:, None]
        t1 = np.where(length > 0, across / np.where(length > 0, length, 1), [1, 0, 0])
        t2 = np.cross(v, t1)
        radius, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
        p1, p2 = radius * np.cos(phi), radius * np.sin(phi)
        s = (1 + v[:, 2]) / 2
        p2 = (1 - s) * np.sqrt(1 - p1**2) + s * p2
        p3 = np.sqrt(np.maximum(0, 1 - p1**2 - p2**2))
        h = p1[:, None] * t1 + p2[:, None] * t2 + p3[:, None] * v
        h = h * [a, a, 1]
        h /= np.sqrt(dot(h, h))[:, None]
        wi = 2 * dot(wo, h)[:, None] * h - wo
        accepted = (wo[:, 2] > 0) & (wi[:, 2] > 0)
        with np.errstate(all="ignore"):
            lambda_o, lambda_i = self.lambda_of(wo), self.lambda_of(wi)
            weight = (1 + lambda_o) / (1 + lambda_o + lambda_i)
        return wi, self.pdf(wo, wi), weight, accepted

    def pdf(self, wo, wi):
        h = wo + wi
        above = (wo[:, 2] > 0) & (wi[:, 2] > 0)
        with np.errstate(all="ignore"):
            h = h / np.sqrt(dot(h, h))[:, None]
            visible = self.d(h) * dot(wo, h) / (1 + self.lambda_of(wo)) / wo[:, 2]
            return np.where(above, visible / (4 * dot(wo, h)), 0)

    def eval(self, wo, wi):
        h = wo + wi
        above = (wo[:, 2] > 0) & (wi[:, 2] > 0)
        with np.errstate(all="ignore"):
            h = h / np.sqrt(dot(h, h))[:, None]
            g2 = 1 / (1 + self.lambda_of(wo) + self.lambda_of(wi))
            return np.where(above, self.d(h) * g2 / (4 * wo[:, 2] * wi[:, 2]), 0)


def check(bsdf, **options):
    """One view of an object with the three functions."""
    return plumbline.check_bsdf(
        type(bsdf).__name__.lower(),
        sample=bsdf.sample,
        pdf=bsdf.pdf,
        eval=bsdf.eval,
        **{**ONE_VIEW, **options},
    )
