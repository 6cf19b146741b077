// SPDX-License-Identifier: Apache-2.0
#include "fluid/momentum/momentum_balance.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/plugin.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace dust::fluid {
namespace {

DUST_KERNEL void begin_row(int n, std::ptrdiff_t s, double density, bool is_whole, double step,
                           const double* eps, const double* u, const double* deferred,
                           const double* source, double* excess, double* with_deferred) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double share = 0.5 * (eps[i] + eps[i - s]);
    excess[i] -= density * share * u[i];
    with_deferred[i] = source[i] - deferred[i] / ((is_whole ? 1.0 : share) * step);
  }
}

/// What flows out of a control volume along one direction, per volume [1/s].
inline __attribute__((always_inline)) double outflow(const double* flux, std::ptrdiff_t s,
                                                     std::ptrdiff_t across, double per_length,
                                                     double before) {
  const double high = 0.5 * (flux[s] + flux[s - across]);
  const double low = 0.5 * (flux[0] + flux[-across]);
  return before + per_length * (high - low);
}

DUST_KERNEL void convection_row(int n, double mass, const RowFlux& flux, const double* eps,
                                const double* convection, const double* u, double* excess) {
  const std::ptrdiff_t s = flux.across;
  const auto [x, y, z] = flux.through;
  const auto [sx, sy, sz] = flux.stride;
  const auto [hx, hy, hz] = flux.per_length;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double out = outflow(x + i, sx, s, hx, 0.0);
    out = outflow(y + i, sy, s, hy, out);
    out = outflow(z + i, sz, s, hz, out);
    excess[i] += mass * (0.5 * (eps[i] + eps[i - s]) * convection[i] + out * u[i]);
  }
}

DUST_KERNEL void end_row(int n, std::ptrdiff_t s, double density, bool is_whole, double step,
                         double last, const double* eps, const double* before, const double* u,
                         const double* source, const double* coefficient, const double* drag,
                         const double* stress, double* excess, double* deferred) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double share = 0.5 * (eps[i] + eps[i - s]);
    const double change = share - 0.5 * (before[i] + before[i - s]);
    const double force = source[i] - coefficient[i] * drag[i] + stress[i];
    const double now = excess[i] + density * share * u[i] - (is_whole ? 1.0 : share) * step * force;
    excess[i] = now;
    deferred[i] = now - density * change * last * u[i];
  }
}

/// In a loop of its own, which a vector of bytes does not hold up.
DUST_KERNEL void keep_plain(int n, const FaceKind* kind, double* values) {
  for (int i = 0; i < n; ++i) values[i] = kind[i] == FaceKind::plain ? values[i] : 0.0;
}

/// Whether all that makes the stencil of a face another one is a side of the domain.
bool is_cut_by_side(const CutFace& face) {
  return std::all_of(face.wall_point.begin(), face.wall_point.end(),
                     [](std::int32_t point) { return point < 0; });
}

}  // namespace

MomentumBalance::MomentumBalance(const Grid& grid, const Geometry& geometry,
                                 const FaceProperties& properties)
    : grid_(grid),
      geometry_(geometry),
      properties_(properties),
      excess_(grid),
      deferred_(grid),
      source_(grid),
      eps_before_(grid.size, 1.0) {}

template <class Work>
void MomentumBalance::each_row(const Work& work) const {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) { work(d, j, k, grid_.index(0, j, k), n[0]); });
  }
}

/// Faces in or next to bodies are not counted. Those next to sides are, though along x their
/// stencils stand in the list of cut ones.
void MomentumBalance::leave_out_bodies(int d, int j, int k) {
  const std::ptrdiff_t o = grid_.index(0, j, k);
  const int n = geometry_.extent[d][0];
  const auto row = static_cast<std::size_t>(j + geometry_.extent[d][1] * k);
  const auto begin = static_cast<std::size_t>(geometry_.cut_begin[d][row]);
  const auto end = static_cast<std::size_t>(geometry_.cut_begin[d][row + 1]);
  for (auto* field : {&excess_, &deferred_}) {
    auto& values = field->component[d];
    thread_local std::vector<double> of_cut;
    of_cut.clear();
    for (std::size_t c = begin; c < end; ++c) {
      const CutFace& face = geometry_.cut[d][c];
      of_cut.push_back(is_cut_by_side(face) ? values[static_cast<std::size_t>(face.at)] : 0.0);
    }
    keep_plain(n, &geometry_.kind[d][static_cast<std::size_t>(o)],
               &values[static_cast<std::size_t>(o)]);
    for (std::size_t c = begin; c < end; ++c) {
      values[static_cast<std::size_t>(geometry_.cut[d][c].at)] = of_cut[c - begin];
    }
  }
}

/// Faces on sides are not counted.
void MomentumBalance::leave_out_sides(int d, int j, int k) {
  if (grid_.is_periodic[d]) return;
  const int n = geometry_.extent[d][0];
  const int at = d == 1 ? j : k;
  const std::ptrdiff_t o = grid_.index(0, j, k);
  for (auto* field : {&excess_, &deferred_}) {
    double* row = &field->component[d][o];
    if (d == 0) {
      row[0] = row[grid_.count[0]] = 0.0;
    } else if (at == 0 || at == grid_.count[d]) {
      std::fill_n(row, n, 0.0);
    }
  }
}

void MomentumBalance::begin(const FaceField& u, StepVoidFraction& void_fraction,
                            const FaceField& source, double step) {
  const CellField& eps = void_fraction.field();
  each_row([&](int d, int, int, std::ptrdiff_t o, int n) {
    begin_row(n, grid_.stride[d], properties_.density(),
              properties_.momentum_set() == MomentumSet::three, step, &eps[o], &u.component[d][o],
              &deferred_.component[d][o], &source.component[d][o], &excess_.component[d][o],
              &source_.component[d][o]);
  });
  void_fraction.give_away(eps_before_);
}

void MomentumBalance::add_convection(int d, std::ptrdiff_t o, double time, const double* u,
                                     const double* eps, const double* convection,
                                     const RowFlux& flux) {
  convection_row(geometry_.extent[d][0], time * properties_.density(), flux, eps, convection, u,
                 &excess_.component[d][o]);
}

void MomentumBalance::end(const FaceField& u, const CellField& eps, const Acted& acted,
                          const FaceField& drag_velocity, const FaceField& stress, double step,
                          double last) {
  each_row([&](int d, int j, int k, std::ptrdiff_t o, int n) {
    end_row(n, grid_.stride[d], properties_.density(),
            properties_.momentum_set() == MomentumSet::three, step, last, &eps[o], &eps_before_[o],
            &u.component[d][o], &acted.source.component[d][o], &acted.coefficient.component[d][o],
            &drag_velocity.component[d][o], &stress.component[d][o], &excess_.component[d][o],
            &deferred_.component[d][o]);
    leave_out_bodies(d, j, k);
    leave_out_sides(d, j, k);
  });
}

void MomentumBalance::save(sdk::ArchiveWriter& archive) const {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    archive.numbers("excess_" + axis, excess_.component[d]);
    archive.numbers("owed_" + axis, deferred_.component[d]);
  }
}

void MomentumBalance::load(sdk::ArchiveReader& archive) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    for (auto* field : {&excess_, &deferred_}) {
      auto values = archive.numbers((field == &deferred_ ? "owed_" : "excess_") + axis);
      if (values.size() != grid_.size) {
        throw sdk::ModelError("the checkpoint's momentum balance belongs to another grid");
      }
      field->component[d] = std::move(values);
    }
  }
}

}  // namespace dust::fluid
