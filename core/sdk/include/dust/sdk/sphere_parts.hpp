// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

/// Shares of a unit sphere's volume beyond one, two and three perpendicular planes. Distances are
/// from the centre, 0 <= a, b, c <= 1; the share is that of { x > a, y > b, z > c }.
///
/// Own derivation. Gauss' theorem with the field r/3 turns the volume of the part into its
/// surfaces:
///   3 V = S - a A_a - b A_b - c A_c ,
/// S the part of the sphere, A_a the flat face on x = a. S follows from the theorem of Gauss and
/// Bonnet: S = 2 pi - sum(a phi_a) - sum(psi), phi_a the angle of the arc on x = a and psi the
/// exterior angles where two arcs meet, cos(psi_ab) = -a b / sqrt((1 - a^2)(1 - b^2)).
namespace dust::sdk::sphere_parts {

inline constexpr double k_sphere = 4.0 / 3.0 * std::numbers::pi;

/// Share beyond x = a.
constexpr double cap(double a) { return 0.25 * (1.0 - a) * (1.0 - a) * (2.0 + a); }

/// Angle whose cosine is `c`, for arguments that rounding may carry beyond 1.
inline double angle_of(double c) { return std::acos(std::clamp(c, -1.0, 1.0)); }

/// Share beyond x = a and y = b.
inline double edge(double a, double b) {
  if (a * a + b * b >= 1.0) return 0.0;
  const double rho_a = std::sqrt(1.0 - a * a);
  const double rho_b = std::sqrt(1.0 - b * b);
  const double half_chord = std::sqrt(1.0 - a * a - b * b);
  const double half_a = angle_of(b / rho_a);  // half of phi_a
  const double half_b = angle_of(a / rho_b);
  const double psi = angle_of(-a * b / (rho_a * rho_b));
  const double surface = 2.0 * (std::numbers::pi - a * half_a - b * half_b - psi);
  const double face_a = rho_a * rho_a * half_a - b * half_chord;
  const double face_b = rho_b * rho_b * half_b - a * half_chord;
  return std::max(0.0, (surface - a * face_a - b * face_b) / (3.0 * k_sphere));
}

/// Share beyond x = a, y = b and z = c.
inline double corner(double a, double b, double c) {
  if (a * a + b * b + c * c >= 1.0) return 0.0;
  const double rho_a = std::sqrt(1.0 - a * a);
  const double rho_b = std::sqrt(1.0 - b * b);
  const double rho_c = std::sqrt(1.0 - c * c);
  const double phi_a = angle_of(b / rho_a) - std::asin(c / rho_a);
  const double phi_b = angle_of(c / rho_b) - std::asin(a / rho_b);
  const double phi_c = angle_of(a / rho_c) - std::asin(b / rho_c);
  // Ends of the three edges that meet in the corner.
  const double end_ab = std::sqrt(1.0 - a * a - b * b) - c;
  const double end_bc = std::sqrt(1.0 - b * b - c * c) - a;
  const double end_ca = std::sqrt(1.0 - c * c - a * a) - b;
  const double face_a = 0.5 * (rho_a * rho_a * phi_a - b * end_ab - c * end_ca);
  const double face_b = 0.5 * (rho_b * rho_b * phi_b - c * end_bc - a * end_ab);
  const double face_c = 0.5 * (rho_c * rho_c * phi_c - a * end_ca - b * end_bc);
  const double psi = angle_of(-a * b / (rho_a * rho_b)) + angle_of(-b * c / (rho_b * rho_c)) +
                     angle_of(-c * a / (rho_c * rho_a));
  const double surface = 2.0 * std::numbers::pi - a * phi_a - b * phi_b - c * phi_c - psi;
  return std::max(0.0, (surface - a * face_a - b * face_b - c * face_c) / (3.0 * k_sphere));
}

/// Share beyond x = a for any a.
constexpr double any_cap(double a) { return a >= 1.0 ? 0.0 : a <= -1.0 ? 1.0 : cap(a); }

/// Share beyond x = a and y = b for any a, b: what lies beyond -a is the mirror image of what lies
/// before a.
inline double any_edge(double a, double b) {
  if (a >= 1.0 || b >= 1.0) return 0.0;
  if (a <= -1.0) return any_cap(b);
  if (b <= -1.0) return any_cap(a);
  if (a < 0.0) return any_cap(b) - any_edge(-a, b);
  if (b < 0.0) return any_cap(a) - any_edge(a, -b);
  return edge(a, b);
}

/// Share beyond x = a, y = b and z = c for any a, b, c.
inline double any_corner(double a, double b, double c) {
  if (a >= 1.0 || b >= 1.0 || c >= 1.0) return 0.0;
  if (a <= -1.0) return any_edge(b, c);
  if (b <= -1.0) return any_edge(a, c);
  if (c <= -1.0) return any_edge(a, b);
  if (a < 0.0) return any_edge(b, c) - any_corner(-a, b, c);
  if (b < 0.0) return any_edge(a, c) - any_corner(a, -b, c);
  if (c < 0.0) return any_edge(a, b) - any_corner(a, b, -c);
  return corner(a, b, c);
}

}  // namespace dust::sdk::sphere_parts
