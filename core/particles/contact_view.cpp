// SPDX-License-Identifier: Apache-2.0
#include "particles/contact_view.hpp"

#include "particles/impl.hpp"
#include "particles/wall_contacts.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace dust::particles {
namespace {

using contact::BatchColumns;
using contact::k_batch;

/// Contacts with fine grains are evaluated for an instant short against their own steps.
constexpr double k_fine_instant = 1.0 / 256.0;

/// Evaluates contacts as the next step will, on copies of their histories.
class Viewer {
 public:
  explicit Viewer(const Dem::Impl& dem) : dem_(dem) {}

  /// Pairs [begin, end) of a list of one law.
  void pairs(const ContactList& list, std::size_t begin, std::size_t end, std::int32_t law_number,
             double time_step, std::vector<ContactRecord>& out) {
    using B = BatchColumns;
    const std::size_t stride = dem_.history_stride;
    const auto cut = [&](const auto& column, std::size_t width) {
      return std::vector(column.begin() + static_cast<std::ptrdiff_t>(width * begin),
                         column.begin() + static_cast<std::ptrdiff_t>(width * end));
    };
    a_ = cut(list.a, 1);
    b_ = cut(list.b, 1);
    is_touching_ = cut(list.is_touching, 1);
    history_.assign(list.history.begin() + static_cast<std::ptrdiff_t>(stride * begin),
                    list.history.begin() + static_cast<std::ptrdiff_t>(stride * end));
    const contact::PairView view{a_.data(),       b_.data(), is_touching_.data(),
                                 history_.data(), stride,    a_.size()};
    const contact::RowView rows = dem_.row_view();
    const PairLaws& law = dem_.laws[static_cast<std::size_t>(law_number)];
    const int groups = static_cast<int>(stride / 4);
    BatchColumns& columns = thread_columns();
    std::int32_t contacts[k_batch];
    std::size_t next = 0;
    while (next < a_.size()) {
      const std::size_t count = contact::gather_touching(rows, dem_.images, view, next, a_.size(),
                                                         law.range, contacts, columns);
      if (count == 0) continue;
      contact::load_history(view, contacts, count, groups, columns);
      contact::derive_pair_columns(columns, count);
      evaluate_laws(law, columns, count, time_step);
      for (std::size_t q = 0; q < count; ++q) {
        ContactRecord r;
        r.row_i = a_[static_cast<std::size_t>(contacts[q])];
        r.row_j = b_[static_cast<std::size_t>(contacts[q])];
        // Read again from the rows: the law's columns need not keep the separation.
        const sdk::Vec3 apart =
            dem_.separation(dem_.store.position.data() + 4 * static_cast<std::ptrdiff_t>(r.row_i),
                            dem_.store.position.data() + 4 * static_cast<std::ptrdiff_t>(r.row_j));
        r.branch = apart;
        r.overlap = columns.column(B::overlap)[q];
        for (int d = 0; d < 3; ++d) r.force[d] = columns.column(B::force_x + d)[q];
        out.push_back(r);
      }
    }
  }

  /// The contact of one grain with a surface, where there is one.
  void surface(std::int32_t row, std::int32_t number, const double* history, double time_step,
               std::vector<ContactRecord>& out) {
    using B = BatchColumns;
    const Surface& s = dem_.surfaces[static_cast<std::size_t>(number)];
    const GrainAtWall grain = GrainAtWall::from(dem_.row_view(), static_cast<std::size_t>(row));
    const auto law_number =
        dem_.law_of(dem_.store.material[static_cast<std::size_t>(row)], s.material);
    const PairLaws& law = dem_.laws[static_cast<std::size_t>(law_number)];
    const bodies::SurfacePoint near = s.contact(grain.position, grain.radius + law.range);
    const double overlap = grain.radius - near.distance;
    if (!(overlap > -law.range)) return;
    BatchColumns& columns = thread_columns();
    put_at_wall(grain, near, 0, columns);
    derive_wall_columns(s, dem_.time, grain.since, 1, columns);
    for (std::size_t h = 0; h < dem_.history_stride; ++h) {
      std::fill_n(columns.column(B::first_history + static_cast<int>(h)), contact::padded(1),
                  history[h]);
    }
    evaluate_laws(law, columns, 1, time_step);
    ContactRecord r;
    r.row_i = row;
    r.row_j = -1 - number;
    r.branch = -(grain.radius - 0.5 * overlap) * near.normal;
    r.overlap = overlap;
    for (int d = 0; d < 3; ++d) r.force[d] = columns.column(B::force_x + d)[0];
    out.push_back(r);
  }

 private:
  const Dem::Impl& dem_;
  std::vector<std::int32_t> a_;
  std::vector<std::int32_t> b_;
  std::vector<std::uint8_t> is_touching_;
  contact::AlignedVector<double> history_;
};

/// A list without order of laws, sorted into one list per law.
std::vector<ContactList> by_law(const Dem::Impl& dem, const ContactList& list) {
  std::vector<ContactList> lists(dem.laws.size());
  const std::size_t stride = dem.history_stride;
  for (std::size_t q = 0; q < list.size(); ++q) {
    if (list.b[q] < 0) continue;
    const auto law = dem.law_of(dem.store.material[static_cast<std::size_t>(list.a[q])],
                                dem.store.material[static_cast<std::size_t>(list.b[q])]);
    ContactList& to = lists[static_cast<std::size_t>(law)];
    const double* h = list.history.data() + q * stride;
    to.push(list.a[q], list.b[q], list.is_touching[q] != 0 ? h : nullptr, stride);
  }
  return lists;
}

}  // namespace

std::vector<ContactRecord> contact_records(const Dem::Impl& dem) {
  // Since grains came or went, the lists name other rows; they are made new at the next step.
  if (dem.must_sort) return {};
  const std::size_t stride = dem.history_stride;
  std::vector<std::vector<ContactRecord>> found(dem.chunks.size());
  oneapi::tbb::parallel_for(std::size_t{0}, dem.chunks.size(), [&](std::size_t c) {
    const Chunk& chunk = dem.chunks[c];
    Viewer viewer(dem);
    const double step = dem.steps.coarse_step;
    for (const Segment& s : chunk.pairs.segments) {
      viewer.pairs(chunk.pairs, static_cast<std::size_t>(s.begin), static_cast<std::size_t>(s.end),
                   s.law, step, found[c]);
    }
    for (std::size_t q = 0; q < chunk.surfaces.size(); ++q) {
      viewer.surface(chunk.surfaces.a[q], chunk.surfaces.b[q],
                     chunk.surfaces.history.data() + q * stride, step, found[c]);
    }
  });
  std::vector<ContactRecord> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  Viewer viewer(dem);
  const double instant = k_fine_instant * dem.steps.coarse_step;
  const auto lists = by_law(dem, dem.fine);
  for (std::size_t law = 0; law < lists.size(); ++law) {
    if (lists[law].size() == 0) continue;
    viewer.pairs(lists[law], 0, lists[law].size(), static_cast<std::int32_t>(law), instant, all);
  }
  for (std::size_t q = 0; q < dem.fine.size(); ++q) {
    if (dem.fine.b[q] >= 0) continue;
    viewer.surface(dem.fine.a[q], -1 - dem.fine.b[q], dem.fine.history.data() + q * stride, instant,
                   all);
  }
  return all;
}

}  // namespace dust::particles
