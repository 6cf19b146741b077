// SPDX-License-Identifier: Apache-2.0
#include "fluid/momentum/momentum_balance.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/plugin.hpp"
#include "fluid/parallel.hpp"

#include <array>
#include <string>

namespace dust::fluid {
namespace {

DUST_KERNEL void begin_row(int n, std::ptrdiff_t s, double density, bool is_whole, double step,
                           const double* eps, const double* u, const double* owed,
                           const double* source, double* excess, double* with_debt) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double share = 0.5 * (eps[i] + eps[i - s]);
    excess[i] -= density * share * u[i];
    with_debt[i] = source[i] - owed[i] / ((is_whole ? 1.0 : share) * step);
  }
}

DUST_KERNEL void convection_row(int n, std::ptrdiff_t s, double mass, const double* eps,
                                const double* convection, const double* outflow, const double* u,
                                double* excess) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    excess[i] += mass * (0.5 * (eps[i] + eps[i - s]) * convection[i] + outflow[i] * u[i]);
  }
}

DUST_KERNEL void end_row(int n, std::ptrdiff_t s, double density, bool is_whole, double step,
                         double last, const double* eps, const double* before, const double* u,
                         const double* source, const double* coefficient, const double* drag,
                         const double* stress, double* excess, double* owed) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double share = 0.5 * (eps[i] + eps[i - s]);
    const double change = share - 0.5 * (before[i] + before[i - s]);
    const double force = source[i] - coefficient[i] * drag[i] + stress[i];
    const double now = excess[i] + density * share * u[i] - (is_whole ? 1.0 : share) * step * force;
    excess[i] = now;
    owed[i] = now - density * change * last * u[i];
  }
}

}  // namespace

MomentumBalance::MomentumBalance(const Grid& grid, const Geometry& geometry,
                                 const FaceProperties& properties)
    : grid_(grid),
      geometry_(geometry),
      properties_(properties),
      excess_(grid),
      owed_(grid),
      source_(grid) {}

template <class Work>
void MomentumBalance::each_row(const Work& work) const {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) { work(d, j, k, grid_.index(0, j, k), n[0]); });
  }
}

/// Faces of a row in or next to bodies and on sides are not booked.
void MomentumBalance::leave_out(int d, int j, int k) {
  const std::ptrdiff_t o = grid_.index(0, j, k);
  const int n = geometry_.extent[d][0];
  for (int i = 0; i < n; ++i) {
    const int at = std::array{i, j, k}[static_cast<std::size_t>(d)];
    const bool is_side = !grid_.is_periodic[d] && (at == 0 || at == grid_.count[d]);
    if (!is_side && geometry_.kind[d][o + i] == FaceKind::plain) continue;
    excess_.component[d][o + i] = owed_.component[d][o + i] = 0.0;
  }
}

void MomentumBalance::begin(const FaceField& u, const CellField& eps, const FaceField& source,
                            double step) {
  eps_before_ = eps;
  each_row([&](int d, int, int, std::ptrdiff_t o, int n) {
    begin_row(n, grid_.stride[d], properties_.density(),
              properties_.momentum_set() == MomentumSet::three, step, &eps[o], &u.component[d][o],
              &owed_.component[d][o], &source.component[d][o], &excess_.component[d][o],
              &source_.component[d][o]);
  });
}

void MomentumBalance::add_convection(int d, std::ptrdiff_t o, double time, const double* u,
                                     const double* eps, const double* convection,
                                     const double* outflow) {
  convection_row(geometry_.extent[d][0], grid_.stride[d], time * properties_.density(), eps,
                 convection, outflow, u, &excess_.component[d][o]);
}

void MomentumBalance::end(const FaceField& u, const CellField& eps, const Exchange& exchange,
                          const FaceField& drag_velocity, const FaceField& stress, double step,
                          double last) {
  each_row([&](int d, int j, int k, std::ptrdiff_t o, int n) {
    end_row(n, grid_.stride[d], properties_.density(),
            properties_.momentum_set() == MomentumSet::three, step, last, &eps[o], &eps_before_[o],
            &u.component[d][o], &exchange.source.component[d][o],
            &exchange.coefficient.component[d][o], &drag_velocity.component[d][o],
            &stress.component[d][o], &excess_.component[d][o], &owed_.component[d][o]);
    leave_out(d, j, k);
  });
}

void MomentumBalance::save(sdk::ArchiveWriter& archive) const {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    archive.numbers("excess_" + axis, excess_.component[d]);
    archive.numbers("owed_" + axis, owed_.component[d]);
  }
}

void MomentumBalance::load(sdk::ArchiveReader& archive) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    for (auto* field : {&excess_, &owed_}) {
      auto values = archive.numbers((field == &owed_ ? "owed_" : "excess_") + axis);
      if (values.size() != grid_.size) {
        throw sdk::ModelError("the checkpoint's momentum book belongs to another grid");
      }
      field->component[d] = std::move(values);
    }
  }
}

}  // namespace dust::fluid
