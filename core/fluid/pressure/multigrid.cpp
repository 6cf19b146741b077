// SPDX-License-Identifier: Apache-2.0
#include "fluid/pressure/multigrid.hpp"

#include "dust/sdk/plugin.hpp"
#include "fluid/one_colour.hpp"
#include "fluid/parallel.hpp"

#include <cstdint>

namespace dust::fluid {
namespace {

constexpr int k_coarsest_cells = 60;
constexpr int k_coarsest_sweeps = 12;
/// The level from which on a cycle visits the next one twice. From the first on it takes no fewer
/// iterations in the box of the transfer point; never takes 10 instead of 7
/// (tests/bench/fluid_bench).
constexpr std::size_t k_first_twice = 2;
/// Directions up to this times the smallest spacing are coarsened together.
constexpr double k_same_spacing = 1.5;

/// Numbers of a row that are found first and then put in, every other one. In one go, each next to
/// those that its neighbours read, the loop would have to go number by number.
constexpr int k_block = 512;

DUST_KERNEL void smooth_row(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, int parity, bool has_y,
                            const float* ax, const float* ay, const float* az, const float* inverse,
                            const float* b, float* x) {
  if constexpr (k_visits_one_colour) {
    for (int i = parity; i < n; i += 2) {
      float sum = b[i] + ax[i] * x[i - 1] + ax[i + 1] * x[i + 1];
      if (has_y) sum = sum + ay[i] * x[i - sy] + ay[i + sy] * x[i + sy];
      x[i] = (sum + az[i] * x[i - sz] + az[i + sz] * x[i + sz]) * inverse[i];
    }
    return;
  }
  alignas(64) float next[k_block];
  for (int first = 0; first < n; first += k_block) {
    const int end = std::min(first + k_block, n);
    float* const found = next - first;
    if (has_y) {
#pragma GCC ivdep
      for (int i = first; i < end; ++i) {
        found[i] = (b[i] + ax[i] * x[i - 1] + ax[i + 1] * x[i + 1] + ay[i] * x[i - sy] +
                    ay[i + sy] * x[i + sy] + az[i] * x[i - sz] + az[i + sz] * x[i + sz]) *
                   inverse[i];
      }
    } else {
#pragma GCC ivdep
      for (int i = first; i < end; ++i) {
        found[i] = (b[i] + ax[i] * x[i - 1] + ax[i + 1] * x[i + 1] + az[i] * x[i - sz] +
                    az[i + sz] * x[i + sz]) *
                   inverse[i];
      }
    }
    // Every lane is written, the other colour with its own old value: neighbours read no change.
#pragma GCC ivdep
    for (int i = first; i < end; ++i) x[i] = ((i + parity) & 1) ? x[i] : found[i];
  }
}

DUST_KERNEL void smooth_zero_row(int n, int parity, const float* inverse, const float* b,
                                 float* x) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) x[i] = ((i + parity) & 1) ? 0.0F : b[i] * inverse[i];
}

DUST_KERNEL void flat_residual_row(int n, std::ptrdiff_t sz, const float* ax, const float* az,
                                   const float* mask, const float* b, const float* x, float* r) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    r[i] = mask[i] * (b[i] + ax[i] * (x[i - 1] - x[i]) + ax[i + 1] * (x[i + 1] - x[i]) +
                      az[i] * (x[i - sz] - x[i]) + az[i + sz] * (x[i + sz] - x[i]));
  }
}

DUST_KERNEL void residual_row(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, const float* ax,
                              const float* ay, const float* az, const float* mask, const float* b,
                              const float* x, float* r) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    r[i] = mask[i] * (b[i] + ax[i] * (x[i - 1] - x[i]) + ax[i + 1] * (x[i + 1] - x[i]) +
                      ay[i] * (x[i - sy] - x[i]) + ay[i + sy] * (x[i + sy] - x[i]) +
                      az[i] * (x[i - sz] - x[i]) + az[i + sz] * (x[i + sz] - x[i]));
  }
}

DUST_KERNEL void add_pairs_row(int n, const float* r, float* b) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) b[i] += r[2 * i] + r[2 * i + 1];
}

DUST_KERNEL void prolong_row(int n, int factor, const float* mask, const float* coarse, float* x) {
  if (factor == 2) {
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) x[i] += mask[i] * coarse[i >> 1];
  } else {
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) x[i] += mask[i] * coarse[i];
  }
}

DUST_KERNEL void invert_row(int n, std::ptrdiff_t sy, std::ptrdiff_t sz, const float* ax,
                            const float* ay, const float* az, float* inverse) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float d = ax[i] + ax[i + 1] + ay[i] + ay[i + sy] + az[i] + az[i + sz];
    inverse[i] = d > 0.0F ? 1.0F / d : 0.0F;
  }
}

std::unique_ptr<MultigridLevel> coarse_level(MultigridLevel& fine) {
  double smallest = 0.0;
  long cells = 1;
  for (int d = 0; d < 3; ++d) {
    cells *= fine.count[d];
    if (fine.count[d] > 1 && (smallest == 0.0 || fine.spacing[d] < smallest)) {
      smallest = fine.spacing[d];
    }
  }
  if (cells <= k_coarsest_cells) return nullptr;
  auto coarse = std::make_unique<MultigridLevel>();
  for (int d = 0; d < 3; ++d) {
    const bool joins = fine.count[d] > 1 && fine.spacing[d] <= k_same_spacing * smallest;
    fine.factor[d] = joins ? 2 : 1;
    coarse->count[d] = joins ? (fine.count[d] + 1) / 2 : fine.count[d];
    coarse->spacing[d] = fine.spacing[d] * fine.factor[d];
    coarse->is_periodic[d] = fine.is_periodic[d];
  }
  constexpr int k_pad = 8;
  // As in Grid: the rows of a flat grid lie one after the other.
  const std::ptrdiff_t row = (coarse->count[0] + 2 * k_pad + 7) / 8 * 8;
  coarse->is_flat = fine.is_flat;
  const bool is_flat = coarse->count[1] == 1;
  coarse->stride[1] = is_flat ? row * (coarse->count[2] + 2) : row;
  coarse->stride[2] = is_flat ? row : row * (coarse->count[1] + 2);
  coarse->start = k_pad + coarse->stride[1] + coarse->stride[2];
  const auto size = static_cast<std::size_t>(row) * (coarse->count[1] + 2) * (coarse->count[2] + 2);
  for (auto* a : {&coarse->face[0], &coarse->face[1], &coarse->face[2], &coarse->inverse_diagonal,
                  &coarse->x, &coarse->b}) {
    a->assign(size, 0.0F);
  }
  coarse->mask.assign(size, 1.0F);
  return coarse;
}

}  // namespace

Multigrid::Multigrid(MultigridLevel finest) {
  levels_.push_back(std::make_unique<MultigridLevel>(std::move(finest)));
  while (auto coarse = coarse_level(*levels_.back())) {
    build_masks(*levels_.back());
    coarsen_faces(*levels_.back(), *coarse);
    levels_.push_back(std::move(coarse));
  }
}

void Multigrid::prepare() {
  invert_diagonal(*levels_[0]);
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    coarsen_faces(*levels_[l - 1], *levels_[l]);
    invert_diagonal(*levels_[l]);
  }
}

void Multigrid::wrap(MultigridLevel& level, std::vector<float>& values) {
  const auto& n = level.count;
  for (int d = 0; d < 3; ++d) {
    if (!level.is_periodic[d]) continue;
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    for (int a = 0; a < n[e]; ++a) {
      for (int b = 0; b < n[f]; ++b) {
        const std::ptrdiff_t o = level.start + a * level.stride[e] + b * level.stride[f];
        const std::ptrdiff_t s = level.stride[d];
        values[o - s] = values[o + (n[d] - 1) * s];
        values[o + n[d] * s] = values[o];
      }
    }
  }
}

void Multigrid::build_masks(MultigridLevel& fine) const {
  const auto& n = fine.count;
  const std::array<int, 3> blocks = {(n[0] + fine.factor[0] - 1) / fine.factor[0],
                                     (n[1] + fine.factor[1] - 1) / fine.factor[1],
                                     (n[2] + fine.factor[2] - 1) / fine.factor[2]};
  for_rows(n[0], blocks[1], blocks[2], [&](int block_j, int block_k) {
    for (int block_i = 0; block_i < blocks[0]; ++block_i) {
      // The up to 8 cells of the aggregate; joined ones take the smallest number among them.
      std::array<std::ptrdiff_t, 8> at{};
      std::array<int, 8> part{};
      std::array<bool, 8> is_in{};
      for (int t = 0; t < 8; ++t) {
        const std::array<int, 3> offset = {t & 1, t >> 1 & 1, t >> 2};
        const std::array<int, 3> block = {block_i, block_j, block_k};
        bool in = true;
        std::ptrdiff_t o = fine.start;
        for (int d = 0; d < 3; ++d) {
          const int c = block[d] * fine.factor[d] + offset[d];
          in = in && offset[d] < fine.factor[d] && c < n[d];
          o += c * fine.stride[d];
        }
        part[t] = t;
        at[t] = o;
        if (in) {
          float sum = 0.0F;
          for (int d = 0; d < 3; ++d) sum += fine.face[d][o] + fine.face[d][o + fine.stride[d]];
          in = sum > 0.0F;
        }
        is_in[t] = in;
      }
      for (int pass = 0; pass < 4; ++pass) {
        for (int t = 0; t < 8; ++t) {
          for (int d = 0; d < 3; ++d) {
            const int u = t | 1 << d;
            if (u == t || !is_in[t] || !is_in[u] || !(fine.face[d][at[u]] > 0.0F)) continue;
            part[t] = part[u] = std::min(part[t], part[u]);
          }
        }
      }
      int best = -1;
      int most = 0;
      for (int t = 0; t < 8; ++t) {
        int size = 0;
        for (int u = 0; u < 8; ++u) size += is_in[u] && part[u] == t ? 1 : 0;
        if (size > most) {
          most = size;
          best = t;
        }
      }
      for (int t = 0; t < 8; ++t) {
        if (is_in[t]) fine.mask[at[t]] = part[t] == best ? 1.0F : 0.0F;
      }
    }
  });
  wrap(fine, fine.mask);
}

void Multigrid::coarsen_faces(const MultigridLevel& fine, MultigridLevel& coarse) const {
  for (int d = 0; d < 3; ++d) {
    std::array<int, 3> n = coarse.count;
    n[d] += 1;
    const float scale = fine.factor[d] == 2 ? 0.5F : 1.0F;
    const std::ptrdiff_t s = fine.stride[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      for (int i = 0; i < n[0]; ++i) {
        const std::array<int, 3> c = {i, j, k};
        std::array<int, 3> from{};
        std::array<int, 3> to{};
        for (int e = 0; e < 3; ++e) {
          from[e] = std::min(c[e] * fine.factor[e], fine.count[e]);
          to[e] = e == d ? from[e] + 1 : std::min(from[e] + fine.factor[e], fine.count[e]);
        }
        float sum = 0.0F;
        for (int z = from[2]; z < to[2]; ++z) {
          for (int y = from[1]; y < to[1]; ++y) {
            for (int x = from[0]; x < to[0]; ++x) {
              const std::ptrdiff_t o = index_of(fine, x, y, z);
              sum += fine.face[d][o] * fine.mask[o] * fine.mask[o - s];
            }
          }
        }
        coarse.face[d][index_of(coarse, i, j, k)] = scale * sum;
      }
    });
  }
}

void Multigrid::invert_diagonal(MultigridLevel& l) {
  for_rows(l.count[0], l.count[1], l.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = index_of(l, 0, j, k);
    invert_row(l.count[0], l.stride[1], l.stride[2], &l.face[0][o], &l.face[1][o], &l.face[2][o],
               &l.inverse_diagonal[o]);
  });
}

void Multigrid::smooth(MultigridLevel& l, int colour, bool from_zero) const {
  const bool has_y = l.count[1] > 1;
  for_rows(l.count[0], l.count[1], l.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = index_of(l, 0, j, k);
    const int parity = (j + k + colour) & 1;
    if (from_zero) {
      smooth_zero_row(l.count[0], parity, &l.inverse_diagonal[o], &l.b[o], &l.x[o]);
    } else {
      smooth_row(l.count[0], l.stride[1], l.stride[2], parity, has_y, &l.face[0][o], &l.face[1][o],
                 &l.face[2][o], &l.inverse_diagonal[o], &l.b[o], &l.x[o]);
    }
  });
  wrap(l, l.x);
}

void Multigrid::restrict_residual(std::size_t level) {
  const MultigridLevel& f = *levels_[level];
  MultigridLevel& c = *levels_[level + 1];
  for_rows(f.count[0] * f.factor[1] * f.factor[2], c.count[1], c.count[2], [&](int j, int k) {
    thread_local std::vector<float> row;
    row.assign(static_cast<std::size_t>(f.count[0]) + 1, 0.0F);
    float* b = &c.b[index_of(c, 0, j, k)];
    std::fill_n(b, c.count[0], 0.0F);
    for (int z = k * f.factor[2]; z < std::min((k + 1) * f.factor[2], f.count[2]); ++z) {
      for (int y = j * f.factor[1]; y < std::min((j + 1) * f.factor[1], f.count[1]); ++y) {
        const std::ptrdiff_t o = index_of(f, 0, y, z);
        if (f.is_flat) {
          flat_residual_row(f.count[0], f.stride[2], &f.face[0][o], &f.face[2][o], &f.mask[o],
                            &f.b[o], &f.x[o], row.data());
        } else {
          residual_row(f.count[0], f.stride[1], f.stride[2], &f.face[0][o], &f.face[1][o],
                       &f.face[2][o], &f.mask[o], &f.b[o], &f.x[o], row.data());
        }
        if (f.factor[0] == 2) {
          add_pairs_row(c.count[0], row.data(), b);
        } else {
          for (int i = 0; i < c.count[0]; ++i) b[i] += row[i];
        }
      }
    }
  });
}

void Multigrid::prolong(std::size_t level) {
  MultigridLevel& f = *levels_[level];
  const MultigridLevel& c = *levels_[level + 1];
  for_rows(f.count[0], f.count[1], f.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = index_of(f, 0, j, k);
    prolong_row(f.count[0], f.factor[0], &f.mask[o],
                &c.x[index_of(c, 0, j / f.factor[1], k / f.factor[2])], &f.x[o]);
  });
  wrap(f, f.x);
}

void Multigrid::cycle(std::size_t l, bool from_zero) {
  MultigridLevel& f = *levels_[l];
  smooth(f, 0, from_zero);
  smooth(f, 1, false);
  if (l + 1 == levels_.size()) {
    for (int s = 1; s < k_coarsest_sweeps; ++s) {
      smooth(f, 0, false);
      smooth(f, 1, false);
    }
    for (int s = 0; s < k_coarsest_sweeps; ++s) {
      smooth(f, 1, false);
      smooth(f, 0, false);
    }
    return;
  }
  smooth(f, 0, false);
  smooth(f, 1, false);
  restrict_residual(l);
  cycle(l + 1, true);
  if (l >= k_first_twice && l + 2 < levels_.size()) cycle(l + 1, false);
  prolong(l);
  for (int s = 0; s < 2; ++s) {
    smooth(f, 1, false);
    smooth(f, 0, false);
  }
}

void Multigrid::cycle() { cycle(0, true); }

}  // namespace dust::fluid
