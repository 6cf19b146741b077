// SPDX-License-Identifier: Apache-2.0
#include "fluid/momentum_book.hpp"

#include "dust/sdk/error.hpp"
#include "fluid/parallel.hpp"

#include <string>

namespace dust::fluid {

MomentumBook::MomentumBook(const Grid& grid, const Geometry& geometry,
                           const FaceProperties& properties)
    : grid_(grid), geometry_(geometry), properties_(properties), excess_(grid), owed_(grid) {}

bool MomentumBook::is_booked(int d, std::ptrdiff_t o, std::array<int, 3> at) const {
  if (geometry_.kind[d][static_cast<std::size_t>(o)] != FaceKind::plain) return false;
  return grid_.is_periodic[d] || (at[d] > 0 && at[d] < grid_.count[d]);
}

/// Calls work(d, o, at) for every face of the domain.
template <class Work>
void MomentumBook::for_faces(const Work& work) const {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) work(d, o + i, std::array<int, 3>{i, j, k});
    });
  }
}

void MomentumBook::begin(const FaceField& u, const CellField& eps, const FaceField& source,
                         double step) {
  if (source_.component[0].empty()) source_ = FaceField(grid_);
  eps_before_ = eps;
  const double density = properties_.density();
  const bool is_whole = properties_.is_set_three();
  for_faces([&](int d, std::ptrdiff_t o, const std::array<int, 3>&) {
    const double share = 0.5 * (eps[o] + eps[o - grid_.stride[d]]);
    excess_.component[d][o] -= density * share * u.component[d][o];
    const double back = owed_.component[d][o] / ((is_whole ? 1.0 : share) * step);
    source_.component[d][o] = source.component[d][o] - back;
  });
}

void MomentumBook::add_convection(int d, std::ptrdiff_t o, double time, const double* u,
                                  const double* eps, const double* convection,
                                  const double* outflow) {
  const double mass = time * properties_.density();
  const std::ptrdiff_t s = grid_.stride[d];
  double* excess = &excess_.component[d][o];
  for (int i = 0; i < geometry_.extent[d][0]; ++i) {
    excess[i] += mass * (0.5 * (eps[i] + eps[i - s]) * convection[i] + outflow[i] * u[i]);
  }
}

void MomentumBook::end(const FaceField& u, const CellField& eps, const Exchange& exchange,
                       const FaceField& drag_velocity, const FaceField& stress, double step,
                       double last) {
  const double density = properties_.density();
  const bool is_whole = properties_.is_set_three();
  for_faces([&](int d, std::ptrdiff_t o, const std::array<int, 3>& at) {
    double& excess = excess_.component[d][o];
    double& owed = owed_.component[d][o];
    if (!is_booked(d, o, at)) {
      excess = owed = 0.0;
      return;
    }
    const std::ptrdiff_t below = o - grid_.stride[d];
    const double share = 0.5 * (eps[o] + eps[below]);
    const double change = share - 0.5 * (eps_before_[o] + eps_before_[below]);
    const double force = exchange.source.component[d][o] -
                         exchange.coefficient.component[d][o] * drag_velocity.component[d][o] +
                         stress.component[d][o];
    const double velocity = u.component[d][o];
    excess += density * share * velocity - (is_whole ? 1.0 : share) * step * force;
    owed = excess - density * change * last * velocity;
  });
}

void MomentumBook::save(sdk::ArchiveWriter& archive) const {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    archive.numbers("excess_" + axis, excess_.component[d]);
    archive.numbers("owed_" + axis, owed_.component[d]);
  }
}

void MomentumBook::load(sdk::ArchiveReader& archive) {
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
