// SPDX-License-Identifier: Apache-2.0
#include "resolved/marker_forcing.hpp"

#include "resolved/surrounding_spin.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dust::resolved {
namespace {

using sdk::Vec3;

/// Of the forcing within a sub-step: markers share faces, so that one loop leaves a part.
constexpr int k_loops = 3;
/// Of the force that would stop the slip if it stayed at the marker: spread over three faces and
/// seen through the same function, half of it is left (the squares of the function sum to a half).
constexpr double k_spread = 2.0;

void copy(const fluid::FaceField& from, fluid::FaceField& to) {
  tbb::parallel_for(std::size_t{0}, std::size_t{3}, [&](std::size_t d) {
    std::copy(from.component[d].begin(), from.component[d].end(), to.component[d].begin());
  });
}

}  // namespace

MarkerForcing::MarkerForcing(const fluid::Grid& grid, double density)
    : grid_(grid),
      density_(density),
      spacing_(std::cbrt(grid.cell_volume())),
      source_(grid),
      mean_(grid) {}

std::shared_ptr<const MarkerLattice> MarkerForcing::lattice_of(double diameter) {
  auto& lattice = lattices_[diameter];
  if (!lattice) lattice = std::make_shared<MarkerLattice>(make_lattice(diameter, spacing_));
  return lattice;
}

void MarkerForcing::begin_step(std::vector<Sphere> spheres, std::vector<Forces> forces,
                               const fluid::FaceField& velocity) {
  spheres_ = std::move(spheres);
  marked_.resize(spheres_.size());
  for (std::size_t s = 0; s < spheres_.size(); ++s) {
    Marked& m = marked_[s];
    m.lattice = lattice_of(2.0 * spheres_[s].radius);
    m.forces = std::move(forces[s]);
    m.forces.resize(m.lattice->direction.size());
    m.change.resize(m.forces.size());
    m.has_left.resize(m.forces.size());
    m.given = {};
    for (auto& stencils : m.stencils) stencils.resize(m.forces.size());
  }
  for (auto& component : mean_.component) std::fill(component.begin(), component.end(), 0.0);
  find_turning(velocity);
}

/// docs/theory/resolved.md, eq. (6).
void MarkerForcing::find_turning(const fluid::FaceField& velocity) {
  tbb::parallel_for(std::size_t{0}, spheres_.size(), [&](std::size_t n) {
    Marked& m = marked_[n];
    const Sphere& sphere = spheres_[n];
    const Vec3 spin = sphere.rotation - surrounding_spin(grid_, velocity, *m.lattice, sphere);
    m.turning_ahead = (m.lattice->turning_gain - 1.0) * spin;
  });
}

std::size_t MarkerForcing::markers() const {
  std::size_t sum = 0;
  for (const Marked& m : marked_) sum += m.forces.size();
  return sum;
}

template <class Work>
void MarkerForcing::each_part(const Work& work) const {
  tbb::parallel_for(std::size_t{0}, 3 * spheres_.size(),
                    [&](std::size_t n) { work(n / 3, n % 3); });
}

template <class Take>
void MarkerForcing::each_face(const fluid::ForcedFluid& fluid, const Take& take) {
  tbb::parallel_for(std::size_t{0}, std::size_t{3}, [&](std::size_t d) {
    const double inverse_volume = 1.0 / grid_.cell_volume();
    for (const Marked& m : marked_) {
      m.patches[d].each(grid_, fluid.geometry, static_cast<int>(d),
                        [&](std::ptrdiff_t at, double force) {
                          const auto o = static_cast<std::size_t>(at);
                          const auto below = static_cast<std::size_t>(at - grid_.stride[d]);
                          const double eps = 0.5 * (fluid.eps[o] + fluid.eps[below]);
                          take(d, o, inverse_volume * force, eps);
                        });
    }
  });
}

/// The sphere turns as a whole, and the fluid inside with its markers.
Vec3 MarkerForcing::surface_velocity(std::size_t sphere, std::size_t marker) const {
  const MarkerLattice& lattice = *marked_[sphere].lattice;
  const Sphere& s = spheres_[sphere];
  return s.velocity + cross(s.rotation + marked_[sphere].turning_ahead,
                            lattice.radius * lattice.direction[marker]);
}

void MarkerForcing::place_markers(double time) {
  // Of a sphere that leaves through an open side: there is no fluid that could hold it back.
  for (std::size_t s = 0; s < marked_.size(); ++s) {
    Marked& m = marked_[s];
    const Vec3 centre = spheres_[s].position_after(time);
    for (std::size_t l = 0; l < m.forces.size(); ++l) {
      const Vec3 place = centre + m.lattice->radius * m.lattice->direction[l];
      m.has_left[l] = is_in_domain(grid_, place) ? 0 : 1;
      if (m.has_left[l] != 0) m.forces[l] = {};
    }
  }
  each_part([&](std::size_t s, std::size_t d) {
    const MarkerLattice& lattice = *marked_[s].lattice;
    const Vec3 centre = spheres_[s].position_after(time);
    auto& stencils = marked_[s].stencils[d];
    for (std::size_t l = 0; l < stencils.size(); ++l) {
      stencils[l] =
          stencil_at(grid_, static_cast<int>(d), centre + lattice.radius * lattice.direction[l]);
    }
  });
}

/// What would stop the slip at each marker, as if it were alone; docs/theory/resolved.md, eq. (6).
void MarkerForcing::find_change(const fluid::FaceField& velocity, double step) {
  each_part([&](std::size_t s, std::size_t d) {
    Marked& m = marked_[s];
    const FacePlaces places(grid_, static_cast<int>(d));
    const int axis = static_cast<int>(d);
    const double mass = k_spread * density_ * m.lattice->volume;
    for (std::size_t l = 0; l < m.forces.size(); ++l) {
      if (m.has_left[l] != 0) {
        m.change[l][axis] = 0.0;
        continue;
      }
      const double seen = places.mean(m.stencils[d][l], velocity.component[d].data());
      m.change[l][axis] = mass * (surface_velocity(s, l)[axis] - seen) / step;
      m.forces[l][axis] += m.change[l][axis];
    }
  });
}

/// docs/theory/resolved.md, eq. (5), (7): the sums.
void MarkerForcing::spread(Forces Marked::*forces) {
  each_part([&](std::size_t s, std::size_t d) {
    Marked& m = marked_[s];
    FacePatch& patch = m.patches[d];
    patch.clear(m.stencils[d]);
    const Forces& at = m.*forces;
    for (std::size_t l = 0; l < at.size(); ++l) {
      patch.add(m.stencils[d][l], at[l][static_cast<int>(d)]);
    }
  });
}

void MarkerForcing::note_given(Forces Marked::*forces, double step) {
  for (Marked& m : marked_) {
    const Forces& at = m.*forces;
    for (std::size_t l = 0; l < at.size(); ++l) {
      const Vec3 impulse = step * at[l];
      m.given.linear += impulse;
      m.given.angular += cross(m.lattice->radius * m.lattice->direction[l], impulse);
    }
  }
}

const fluid::FaceField& MarkerForcing::add_to(const fluid::FaceField& given,
                                              const fluid::ForcedFluid& fluid,
                                              const fluid::ForcedPart& part) {
  copy(given, source_);
  place_markers(part.until);
  spread(&Marked::forces);
  note_given(&Marked::forces, part.step);
  each_face(fluid, [&](std::size_t d, std::size_t at, double force, double eps) {
    source_.component[d][at] += force / eps;
    mean_.component[d][at] += part.share * force;
  });
  return source_;
}

void MarkerForcing::force(fluid::FaceField& velocity, const fluid::ForcedFluid& fluid,
                          const fluid::ForcedPart& part) {
  for (int loop = 0; loop < k_loops; ++loop) {
    find_change(velocity, part.step);
    spread(&Marked::change);
    note_given(&Marked::change, part.step);
    each_face(fluid, [&](std::size_t d, std::size_t at, double force, double eps) {
      velocity.component[d][at] += part.step / density_ * force / eps;
      mean_.component[d][at] += part.share * force;
    });
  }
}

/// docs/theory/resolved.md, eq. (8).
const fluid::FaceField& MarkerForcing::add_mean_to(const fluid::FaceField& given,
                                                   const fluid::CellField& eps) {
  tbb::parallel_for(std::size_t{0}, std::size_t{3}, [&](std::size_t d) {
    auto& source = source_.component[d];
    const auto& mean = mean_.component[d];
    const auto stride = static_cast<std::size_t>(grid_.stride[d]);
    std::copy(given.component[d].begin(), given.component[d].end(), source.begin());
    for (std::size_t at = stride; at < source.size(); ++at) {
      if (mean[at] != 0.0) source[at] += mean[at] / (0.5 * (eps[at] + eps[at - stride]));
    }
  });
  return source_;
}

double MarkerForcing::largest_slip(const fluid::FaceField& velocity) const {
  double largest2 = 0.0;
  for (std::size_t s = 0; s < marked_.size(); ++s) {
    const Marked& m = marked_[s];
    for (std::size_t l = 0; l < m.forces.size(); ++l) {
      if (m.has_left[l] != 0) continue;
      Vec3 slip = surface_velocity(s, l);
      for (int d = 0; d < 3; ++d) {
        const auto& component = velocity.component[static_cast<std::size_t>(d)];
        slip[d] -=
            FacePlaces(grid_, d).mean(m.stencils[static_cast<std::size_t>(d)][l], component.data());
      }
      largest2 = std::max(largest2, dot(slip, slip));
    }
  }
  return std::sqrt(largest2);
}

}  // namespace dust::resolved
