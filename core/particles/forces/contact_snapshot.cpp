// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/contact_snapshot.hpp"

#include "particles/forces/law_stages.hpp"
#include "particles/forces/wall_contacts.hpp"
#include "particles/forces/weight_ratios.hpp"

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
  explicit Viewer(const ContactScene& scene) : scene_(scene) {}

  /// Pairs [begin, end) of a list of one law.
  void pairs(const ContactList& list, std::size_t begin, std::size_t end, std::int32_t law_number,
             double time_step, std::vector<ContactRecord>& out) {
    using B = BatchColumns;
    const std::size_t stride = scene_.laws.history_stride();
    const auto cut = [&](const auto& column, std::size_t width) {
      return column.subspan(width * begin, width * (end - begin));
    };
    const auto a = cut(list.a(), 1);
    const auto b = cut(list.b(), 1);
    const auto touching = cut(list.touching(), 1);
    const auto history = cut(list.histories(), stride);
    is_touching_.assign(touching.begin(), touching.end());
    history_.assign(history.begin(), history.end());
    const contact::PairView view{a.data(),        b.data(), is_touching_.data(),
                                 history_.data(), stride,   a.size()};
    const contact::RowView rows = scene_.rows();
    const PairLaws& law = scene_.laws[static_cast<std::size_t>(law_number)];
    const int groups = static_cast<int>(stride / 4);
    BatchColumns& columns = thread_columns();
    std::int32_t contacts[k_batch];
    std::size_t next = 0;
    while (next < a.size()) {
      const std::size_t count = contact::gather_touching({rows, scene_.images, view, law.range},
                                                         next, a.size(), contacts, columns);
      if (count == 0) continue;
      contact::load_history(view, contacts, count, groups, columns);
      // has_weights speaks of coarse particles alone, and these may be fine.
      find_weight_ratios(scene_.particles, {law, view, columns, count, 0, contacts});
      contact::derive_pair_columns(columns, count);
      evaluate_laws(law, columns, count, time_step);
      for (std::size_t q = 0; q < count; ++q) {
        ContactRecord r;
        r.row_i = a[static_cast<std::size_t>(contacts[q])];
        r.row_j = b[static_cast<std::size_t>(contacts[q])];
        // Read again from the rows: the law's columns need not keep the separation.
        r.branch = contact::nearest_image(
            scene_.images, scene_.particles.position(static_cast<std::size_t>(r.row_i)),
            scene_.particles.position(static_cast<std::size_t>(r.row_j)));
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
    const Surface& s = scene_.surfaces[static_cast<std::size_t>(number)];
    const GrainAtWall grain = GrainAtWall::from(scene_.rows(), static_cast<std::size_t>(row));
    const auto law_number =
        scene_.laws.index(scene_.particles.material(static_cast<std::size_t>(row)), s.material);
    const PairLaws& law = scene_.laws[static_cast<std::size_t>(law_number)];
    const bodies::SurfacePoint near = s.contact(grain.position, grain.radius + law.range);
    const double overlap = grain.radius - near.distance;
    if (!(overlap > -law.range)) return;
    BatchColumns& columns = thread_columns();
    put_at_wall(grain, near, 0, columns);
    derive_wall_columns(s, scene_.time, grain.since, 1, columns);
    for (std::size_t h = 0; h < scene_.laws.history_stride(); ++h) {
      std::fill_n(columns.column(B::first_history + static_cast<int>(h)), contact::padded(1),
                  history[h]);
    }
    ContactRecord r;
    r.wall_velocity = columns.vectors(B::separation_x)[0];
    evaluate_laws(law, columns, 1, time_step);
    r.row_i = row;
    r.row_j = -1 - number;
    r.branch = -(grain.radius - 0.5 * overlap) * near.normal;
    r.overlap = overlap;
    for (int d = 0; d < 3; ++d) r.force[d] = columns.column(B::force_x + d)[0];
    out.push_back(r);
  }

 private:
  const ContactScene& scene_;
  std::vector<std::uint8_t> is_touching_;
  contact::AlignedVector<double> history_;
};

/// A list without order of laws, sorted into one list per law.
std::vector<ContactList> by_law(const ContactScene& scene, const ContactList& list) {
  const PairLawTable& laws = scene.laws;
  std::vector<ContactList> lists(laws.size(), {PartnerKind::particles, laws.history_stride()});
  for (std::size_t q = 0; q < list.size(); ++q) {
    const std::int32_t a = list.a()[q];
    const std::int32_t b = list.b()[q];
    if (b < 0) continue;
    const auto law = laws.index(scene.particles.material(static_cast<std::size_t>(a)),
                                scene.particles.material(static_cast<std::size_t>(b)));
    const bool is_touching = list.touching()[q] != 0;
    lists[static_cast<std::size_t>(law)].push(a, b, is_touching ? list.history(q) : nullptr,
                                              is_touching ? 1 : 0);
  }
  return lists;
}

void view_tile(const ContactScene& scene, const TileContacts& contacts,
               std::vector<ContactRecord>& found) {
  Viewer viewer(scene);
  for (const LawRange& r : contacts.pairs.ranges()) {
    viewer.pairs(contacts.pairs, static_cast<std::size_t>(r.begin), static_cast<std::size_t>(r.end),
                 r.law, scene.step, found);
  }
  const ContactList& walls = contacts.walls;
  for (std::size_t q = 0; q < walls.size(); ++q) {
    viewer.surface(walls.a()[q], walls.b()[q], walls.history(q), scene.step, found);
  }
}

void view_fine(const ContactScene& scene, const ContactList& fine,
               std::vector<ContactRecord>& found) {
  Viewer viewer(scene);
  const double instant = k_fine_instant * scene.step;
  const auto lists = by_law(scene, fine);
  for (std::size_t law = 0; law < lists.size(); ++law) {
    if (lists[law].size() == 0) continue;
    viewer.pairs(lists[law], 0, lists[law].size(), static_cast<std::int32_t>(law), instant, found);
  }
  for (std::size_t q = 0; q < fine.size(); ++q) {
    if (fine.b()[q] >= 0) continue;
    viewer.surface(fine.a()[q], -1 - fine.b()[q], fine.history(q), instant, found);
  }
}

}  // namespace

std::vector<ContactRecord> contact_snapshot(const ContactScene& scene, const InnerList& lists) {
  std::vector<std::vector<ContactRecord>> found(lists.tiles());
  oneapi::tbb::parallel_for(std::size_t{0}, lists.tiles(),
                            [&](std::size_t t) { view_tile(scene, lists.contacts(t), found[t]); });
  std::vector<ContactRecord> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  view_fine(scene, lists.fine(), all);
  return all;
}

}  // namespace dust::particles
