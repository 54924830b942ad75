import plumbline
from diffuse import Diffuse


def test_samples_what_its_pdf_says():
    bsdf = Diffuse()
    report = plumbline.check_bsdf(
        "diffuse",
        sample=bsdf.sample,
        pdf=bsdf.pdf,
        eval=bsdf.eval,
        conventions=["y-up", "cosine-in-eval", "weight-is-f-cosine", "zero-pdf-is-failure"],
        back=False,  # black from below
        angles=[40],  # degrees
        random_directions=0,
    )
    assert report.ok, report
