#include "methods/cvd/predicates.h"

#include <cfloat>
#include <cmath>

#include "methods/cvd/double_double.h"

namespace fracbench::cvd {

namespace {

// A number and a bound of its error, carried along with every operation. The bounds themselves are
// rounded; the factor in sign_of is far above that.
template <typename T>
struct Tracked {
  T value{};
  double error = 0;
};

double magnitude(double x) { return std::abs(x); }
double magnitude(const DoubleDouble& x) { return std::abs(x.high); }
int raw_sign(double x) { return (x > 0) - (x < 0); }
int raw_sign(const DoubleDouble& x) { return x.high != 0 ? raw_sign(x.high) : raw_sign(x.low); }

template <typename T>
constexpr double kUnit = 0x1p-53;
template <>
constexpr double kUnit<DoubleDouble> = 0x1p-102;

template <typename T>
Tracked<T> operator+(const Tracked<T>& a, const Tracked<T>& b) {
  const T value = a.value + b.value;
  return {value, a.error + b.error + kUnit<T> * magnitude(value)};
}
template <typename T>
Tracked<T> operator-(const Tracked<T>& a, const Tracked<T>& b) {
  const T value = a.value - b.value;
  return {value, a.error + b.error + kUnit<T> * magnitude(value)};
}
template <typename T>
Tracked<T> operator*(const Tracked<T>& a, const Tracked<T>& b) {
  const T value = a.value * b.value;
  return {value, magnitude(a.value) * b.error + magnitude(b.value) * a.error + a.error * b.error +
                     kUnit<T> * magnitude(value) + DBL_MIN};
}
template <typename T>
int sign_of(const Tracked<T>& x) {
  return magnitude(x.value) > 1.000001 * x.error ? raw_sign(x.value) : 0;
}

template <typename T>
using Tracked3 = std::array<Tracked<T>, 3>;

template <typename T>
Tracked<T> difference(double a, double b) {
  return Tracked<T>{T(a), 0} - Tracked<T>{T(b), 0};
}
template <typename T>
Tracked3<T> difference(const Vec3& a, const Vec3& b) {
  return {difference<T>(a[0], b[0]), difference<T>(a[1], b[1]), difference<T>(a[2], b[2])};
}
template <typename T>
Tracked<T> dot(const Tracked3<T>& a, const Tracked3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename T>
Tracked3<T> cross(const Tracked3<T>& a, const Tracked3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <typename T>
Tracked<T> bisector(const Vec3& p_i, const Vec3& p_j, const Vec3& x) {
  const Tracked3<T> a = difference<T>(x, p_i);
  const Tracked3<T> b = difference<T>(x, p_j);
  return dot(difference<T>(p_j, p_i), Tracked3<T>{a[0] + b[0], a[1] + b[1], a[2] + b[2]});
}

template <typename T>
Tracked3<T> bisector_over(const Corners& corners, const Vec3& p_i, const Vec3& p_j) {
  return {bisector<T>(p_i, p_j, corners[0]), bisector<T>(p_i, p_j, corners[1]),
          bisector<T>(p_i, p_j, corners[2])};
}

Tracked3<double> tracked(const Bisector& j) {
  return {Tracked<double>{j.at[0].value, j.at[0].error},
          Tracked<double>{j.at[1].value, j.at[1].error},
          Tracked<double>{j.at[2].value, j.at[2].error}};
}

// h_ij at the zero of h_ik on an edge: (j_a k_b - j_b k_a) / (k_b - k_a).
template <typename T>
int on_edge(const Tracked3<T>& k, const Tracked3<T>& j, int a) {
  const int b = (a + 1) % 3;
  return sign_of(j[a] * k[b] - j[b] * k[a]) * sign_of(k[b] - k[a]);
}

// h_ij where h_ik = h_il = 0: with the barycentric weights w = k x l it is (w . j) / sum(w).
template <typename T>
int inside(const Tracked3<T>& k, const Tracked3<T>& l, const Tracked3<T>& j) {
  const Tracked3<T> w = cross(k, l);
  return sign_of(dot(w, j)) * sign_of(w[0] + w[1] + w[2]);
}

template <typename T>
int orientation_in(const Vec3& i, const Vec3& j, const Vec3& k, const Vec3& l) {
  return sign_of(dot(cross(difference<T>(j, i), difference<T>(k, i)), difference<T>(l, i)));
}

template <typename T>
int axis_side_in(const Vec3& i, const Vec3& j, const Vec3& k, const Corners& t) {
  return sign_of(dot(cross(difference<T>(j, i), difference<T>(k, i)),
                     cross(difference<T>(t[1], t[0]), difference<T>(t[2], t[0]))));
}

// The centre of the sphere through i, j, k, l relative to p_i is y with (p_j - p_i) . y =
// |p_j - p_i|^2 / 2 and so on; by Cramer's rule 2 y = sum(r c) / det, and m is outside where
// |p_m - p_i|^2 > (p_m - p_i) . 2 y.
template <typename T>
int side_of_sphere_in(const Vec3& i, const Vec3& j, const Vec3& k, const Vec3& l, const Vec3& m) {
  const Tracked3<T> b = difference<T>(j, i), c = difference<T>(k, i), d = difference<T>(l, i),
                    e = difference<T>(m, i);
  const Tracked3<T> cd = cross(c, d), db = cross(d, b), bc = cross(b, c);
  const Tracked<T> determinant = dot(b, cd);
  const Tracked<T> sum = dot(b, b) * dot(cd, e) + dot(c, c) * dot(db, e) + dot(d, d) * dot(bc, e);
  return sign_of(dot(e, e) * determinant - sum) * sign_of(determinant);
}

template <typename T>
int turn_in(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v) {
  return sign_of(difference<T>(b[u], a[u]) * difference<T>(c[v], a[v]) -
                 difference<T>(b[v], a[v]) * difference<T>(c[u], a[u]));
}

[[noreturn]] void undecided() {
  throw Degenerate("a cell's corner, edge or face touches the body's mesh in a special position");
}

using Wide3 = std::array<DoubleDouble, 3>;

Wide3 wide_difference(const Vec3& a, const Vec3& b) {
  return {two_sum(a[0], -b[0]), two_sum(a[1], -b[1]), two_sum(a[2], -b[2])};
}
DoubleDouble wide_dot(const Wide3& a, const Wide3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Wide3 wide_cross(const Wide3& a, const Wide3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

int Bounded::sign() const { return sign_of(Tracked<double>{value, error}); }

Bounded bisector_value(const Vec3& p_i, const Vec3& p_j, const Vec3& x) {
  const Tracked<double> h = bisector<double>(p_i, p_j, x);
  return {h.value, h.error};
}

int side_of_corner(const CellAndTriangle& where, int corner, const Bisector& j, const Vec3& p_j) {
  if (const int sign = j.at[corner].sign()) return sign;
  if (const int sign = sign_of(bisector<DoubleDouble>(where.site, p_j, where.corners[corner]))) {
    return sign;
  }
  undecided();
}

int side_on_edge(const CellAndTriangle& where, int edge, const Bisector& k, const Vec3& p_k,
                 const Bisector& j, const Vec3& p_j) {
  if (const int sign = on_edge(tracked(k), tracked(j), edge)) return sign;
  if (const int sign = on_edge(bisector_over<DoubleDouble>(where.corners, where.site, p_k),
                               bisector_over<DoubleDouble>(where.corners, where.site, p_j), edge)) {
    return sign;
  }
  undecided();
}

int side_inside(const CellAndTriangle& where, const Bisector& k, const Vec3& p_k, const Bisector& l,
                const Vec3& p_l, const Bisector& j, const Vec3& p_j) {
  if (const int sign = inside(tracked(k), tracked(l), tracked(j))) return sign;
  if (const int sign = inside(bisector_over<DoubleDouble>(where.corners, where.site, p_k),
                              bisector_over<DoubleDouble>(where.corners, where.site, p_l),
                              bisector_over<DoubleDouble>(where.corners, where.site, p_j))) {
    return sign;
  }
  undecided();
}

int axis_side(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Corners& triangle) {
  if (const int sign = axis_side_in<double>(p_i, p_j, p_k, triangle)) return sign;
  if (const int sign = axis_side_in<DoubleDouble>(p_i, p_j, p_k, triangle)) return sign;
  undecided();
}

int orientation(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Vec3& p_l) {
  if (const int sign = orientation_in<double>(p_i, p_j, p_k, p_l)) return sign;
  if (const int sign = orientation_in<DoubleDouble>(p_i, p_j, p_k, p_l)) return sign;
  throw Degenerate("four sites lie in one plane");
}

int side_of_sphere(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Vec3& p_l,
                   const Vec3& p_m) {
  if (const int sign = side_of_sphere_in<double>(p_i, p_j, p_k, p_l, p_m)) return sign;
  if (const int sign = side_of_sphere_in<DoubleDouble>(p_i, p_j, p_k, p_l, p_m)) return sign;
  throw Degenerate("five sites lie on one sphere");
}

int turn(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v) {
  if (const int sign = turn_in<double>(a, b, c, u, v)) return sign;
  return turn_in<DoubleDouble>(a, b, c, u, v);
}

Vec3 point_on_edge(const Vec3& a, const Vec3& b, const Vec3& p_i, const Vec3& p_j) {
  const DoubleDouble at_a = bisector<DoubleDouble>(p_i, p_j, a).value;
  const DoubleDouble at_b = bisector<DoubleDouble>(p_i, p_j, b).value;
  const DoubleDouble t = at_a / (at_a - at_b);
  Vec3 point;
  for (int c = 0; c < 3; ++c) {
    point[c] = (DoubleDouble(a[c]) + t * two_sum(b[c], -a[c])).rounded();
  }
  return point;
}

Vec3 point_in_triangle(const Corners& triangle, const Vec3& p_i, const Vec3& p_j, const Vec3& p_k) {
  Wide3 j, k;
  for (int c = 0; c < 3; ++c) {
    j[c] = bisector<DoubleDouble>(p_i, p_j, triangle[c]).value;
    k[c] = bisector<DoubleDouble>(p_i, p_k, triangle[c]).value;
  }
  const Wide3 w = wide_cross(j, k);
  const DoubleDouble sum = w[0] + w[1] + w[2];
  const DoubleDouble s = w[1] / sum, t = w[2] / sum;
  const Wide3 ab = wide_difference(triangle[1], triangle[0]);
  const Wide3 ac = wide_difference(triangle[2], triangle[0]);
  Vec3 point;
  for (int c = 0; c < 3; ++c) {
    point[c] = (DoubleDouble(triangle[0][c]) + (s * ab[c] + t * ac[c])).rounded();
  }
  return point;
}

Vec3 voronoi_vertex(const Vec3& p_i, const Vec3& p_j, const Vec3& p_k, const Vec3& p_l) {
  const Wide3 b = wide_difference(p_j, p_i), c = wide_difference(p_k, p_i),
              d = wide_difference(p_l, p_i);
  const Wide3 cd = wide_cross(c, d), db = wide_cross(d, b), bc = wide_cross(b, c);
  const DoubleDouble twice = DoubleDouble(2) * wide_dot(b, cd);
  const DoubleDouble bb = wide_dot(b, b), cc = wide_dot(c, c), dd = wide_dot(d, d);
  Vec3 point;
  for (int x = 0; x < 3; ++x) {
    point[x] = (DoubleDouble(p_i[x]) + (bb * cd[x] + cc * db[x] + dd * bc[x]) / twice).rounded();
  }
  return point;
}

}  // namespace fracbench::cvd
