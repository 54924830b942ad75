import numpy as np


class Diffuse:
    """A diffuse reflection of its front: cosθ-weighted directions."""

    albedo = 0.8

    def sample(self, wo, u):
        radius, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
        wi = np.stack([radius * np.cos(phi), np.sqrt(1 - u[:, 0]), radius * np.sin(phi)], axis=-1)
        return wi, self.pdf(wo, wi), self.eval(wo, wi)  # a pdf of 0: no direction could be sampled

    def pdf(self, wo, wi):
        return np.where(above(wo, wi), wi[:, 1] / np.pi, 0)

    def eval(self, wo, wi):
        """f · cosθi"""
        return np.where(above(wo, wi), self.albedo / np.pi * wi[:, 1], 0)


def above(wo, wi):
    return (wo[:, 1] > 0) & (wi[:, 1] > 0)
