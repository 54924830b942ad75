#pragma once

// The vector class of a made-up renderer: components by index only, y is up.
namespace tiny {

class Vector {
 public:
  Vector() = default;
  Vector(float x, float y, float z) : e_{x, y, z} {}
  float operator[](int i) const { return e_[i]; }
  float& operator[](int i) { return e_[i]; }

 private:
  float e_[3] = {0, 0, 0};
};

inline float dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator*(float s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }

}  // namespace tiny
