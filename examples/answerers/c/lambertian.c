/* A Lambertian BSDF that answers plumbline (docs/protocol.md):
     cc -O2 -o lambertian lambertian.c -lm && plumbline verify --exec ./lambertian
   With --faulty it states the pdf of uniform directions, not of those that it samples. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const float kPi = 3.14159265f, kAlbedo = 0.8f;
static int faulty;

static float pdf(const float *wo, const float *wi) { /* [1/sr] */
  return wo[2] > 0 && wi[2] > 0 ? (faulty ? 0.5f : wi[2]) / kPi : 0;
}
static float eval(const float *wo, const float *wi) { /* f [1/sr], without the cosine */
  return wo[2] > 0 && wi[2] > 0 ? kAlbedo / kPi : 0;
}
static void sample(const float *u, float *wi) {
  const float r = sqrtf(u[0]), phi = 2 * kPi * u[1];
  wi[0] = r * cosf(phi), wi[1] = r * sinf(phi), wi[2] = sqrtf(1 - u[0]);
}

static void read_array(float *values, size_t n) { /* headers are 128 bytes long */
  char header[128];
  if (fread(header, 1, 128, stdin) != 128 || fread(values, 4, n, stdin) != n) exit(1);
}
static void write_array(const char *type, size_t n, const char *columns, const void *values, size_t size) {
  char header[129] = "\x93NUMPY\1\0\x76";
  sprintf(header + 10, "%-117s\n", "");
  const int used = sprintf(header + 10, "{'descr': '%s', 'fortran_order': False, 'shape': (%zu,%s), }", type, n, columns);
  header[10 + used] = ' ';
  fwrite(header, 1, 128, stdout);
  fwrite(values, 1, size, stdout);
}

int main(int argc, char **argv) {
  faulty = argc > 1 && strcmp(argv[1], "--faulty") == 0;
  static float wo[3000000], given[3000000], wi[3000000], density[1000000], value[1000000];
  static char line[256], kind[8], accepted[1000000]; /* no query asks for more */
  puts("{\"protocol\": \"plumbline/1\", \"name\": \"lambertian\", \"precision\": \"float32\", "
       "\"numbers\": 2, \"functions\": [\"sample\", \"pdf\", \"eval\"]}");
  fflush(stdout);
  for (size_t n; fgets(line, sizeof line, stdin) != NULL; fflush(stdout)) {
    if (sscanf(line, "{\"query\": %*u, \"kind\": \"%7[a-z]\", \"count\": %zu", kind, &n) != 2) return 1;
    const int sampling = strcmp(kind, "sample") == 0;
    read_array(wo, 3 * n), read_array(sampling ? given : wi, (sampling ? 2 : 3) * n);
    for (size_t i = 0; i < n; ++i) {
      const float *o = wo + 3 * i, *w = wi + 3 * i;
      if (sampling) sample(given + 2 * i, wi + 3 * i), accepted[i] = o[2] > 0 && w[2] > 0;
      density[i] = pdf(o, w), value[i] = eval(o, w);
      if (sampling) value[i] = accepted[i] ? value[i] * w[2] / density[i] : 0;
    }
    fputs(line, stdout); /* an answer begins with the line of its query */
    if (sampling) write_array("<f4", n, " 3", wi, 12 * n);
    if (strcmp(kind, "eval") != 0) write_array("<f4", n, "", density, 4 * n);
    if (strcmp(kind, "pdf") != 0) write_array("<f4", n, "", value, 4 * n);
    if (sampling) write_array("|b1", n, "", accepted, n);
  }
}
