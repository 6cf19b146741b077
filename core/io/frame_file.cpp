// SPDX-License-Identifier: Apache-2.0
#include "io/frame_file.hpp"

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"

#include <array>
#include <cstdio>
#include <map>

namespace dust::io {
namespace {

namespace fs = std::filesystem;

std::vector<float> narrow(std::span<const double> values) { return {values.begin(), values.end()}; }

template <class T>
std::vector<float> interleave(std::span<const T> x, std::span<const T> y, std::span<const T> z) {
  std::vector<float> rows(3 * x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    rows[3 * i] = static_cast<float>(x[i]);
    rows[3 * i + 1] = static_cast<float>(y[i]);
    rows[3 * i + 2] = static_cast<float>(z[i]);
  }
  return rows;
}

Meaning meaning_of(const FieldInfo& field) { return {field.units, field.long_name}; }

const FieldInfo& field(const std::vector<FieldInfo>& fields, const std::string& name) {
  for (const FieldInfo& f : fields) {
    if (name == f.name) return f;
  }
  throw base::RunError("no field '" + name + "'");
}

void write_particles(hid_t file, const sdk::GrainColumns& g, double time) {
  const Handle group = create_group(file, "particles");
  write_attribute(group.get(), "time", time);
  const hsize_t n = g.id.size();
  const auto vectors = [&](const char* name, auto x, auto y, auto z) {
    write_array(group.get(), name, H5T_NATIVE_FLOAT, interleave<double>(x, y, z).data(), {n, 3},
                Storage::compressed, meaning_of(field(particle_fields(), name)));
  };
  const auto scalars = [&](const char* name, hid_t type, const void* data) {
    write_array(group.get(), name, type, data, {n}, Storage::compressed,
                meaning_of(field(particle_fields(), name)));
  };
  vectors("position", g.x, g.y, g.z);
  vectors("velocity", g.velocity_x, g.velocity_y, g.velocity_z);
  vectors("angular_velocity", g.angular_velocity_x, g.angular_velocity_y, g.angular_velocity_z);
  vectors("force", g.force_x, g.force_y, g.force_z);
  scalars("diameter", H5T_NATIVE_FLOAT, narrow(g.diameter).data());
  scalars("weight", H5T_NATIVE_FLOAT, narrow(g.weight).data());
  scalars("mass", H5T_NATIVE_FLOAT, narrow(g.mass).data());
  scalars("material", H5T_NATIVE_INT32, g.material.data());
  scalars("id", H5T_NATIVE_INT64, g.id.data());
}

/// `has_open_fraction`: bodies move or go, so that each frame has its own.
void write_fluid(hid_t file, const sdk::FluidColumns& f, std::span<const float> exchange,
                 double time, bool has_open_fraction) {
  const Handle group = create_group(file, "fluid");
  write_attribute(group.get(), "time", time);
  const hsize_t nx = f.count[0];
  const hsize_t ny = f.count[1];
  const hsize_t nz = f.count[2];
  const auto write = [&](const char* name, const float* data, bool is_vector) {
    const Meaning meaning = meaning_of(field(fluid_fields(), name));
    if (is_vector) {
      write_array(group.get(), name, H5T_NATIVE_FLOAT, data, {nz, ny, nx, 3}, Storage::compressed,
                  meaning);
    } else {
      write_array(group.get(), name, H5T_NATIVE_FLOAT, data, {nz, ny, nx}, Storage::compressed,
                  meaning);
    }
  };
  write("velocity", interleave<float>(f.velocity_x, f.velocity_y, f.velocity_z).data(), true);
  write("pressure", f.pressure.data(), false);
  write("void_fraction", f.void_fraction.data(), false);
  if (exchange.empty()) {
    write("momentum_exchange", std::vector<float>(3 * nx * ny * nz).data(), true);
  } else {
    write("momentum_exchange", exchange.data(), true);
  }
  if (!has_open_fraction) return;
  write_array(group.get(), "open_fraction", H5T_NATIVE_FLOAT, f.open_fraction.data(), {nz, ny, nx},
              Storage::compressed, {"1", "share of the cell not inside a body"});
}

void write_more_of_fluid(hid_t file, const std::vector<SensorField>& fields) {
  for (const SensorField& f : fields) {
    const auto extent = [&](int d) { return static_cast<hsize_t>(f.grid.count[d]); };
    write_array(file, "fluid/" + f.name, H5T_NATIVE_FLOAT, narrow(f.values).data(),
                {extent(2), extent(1), extent(0)}, Storage::compressed,
                {f.unit.c_str(), f.name.c_str()});
  }
}

void write_fields(hid_t file, const std::vector<SensorField>& fields) {
  const Handle all = create_group(file, "sensors");
  std::map<std::string, Handle> groups;
  for (const SensorField& f : fields) {
    auto [group, is_new] = groups.try_emplace(f.sensor);
    if (is_new) group->second = create_group(all.get(), f.sensor);
    const auto extent = [&](int d) { return static_cast<hsize_t>(f.grid.count[d]); };
    write_array(group->second.get(), f.name, H5T_NATIVE_FLOAT, narrow(f.values).data(),
                {extent(2), extent(1), extent(0)}, Storage::compressed,
                {f.unit.c_str(), f.name.c_str()});
    const std::string what = "cannot describe " + f.sensor + "/" + f.name;
    const Handle set(H5Dopen2(group->second.get(), f.name.c_str(), H5P_DEFAULT), H5Dclose, what);
    const std::array<double, 3> origin = {f.grid.origin.x, f.grid.origin.y, f.grid.origin.z};
    const std::array<double, 3> spacing = {f.grid.spacing.x, f.grid.spacing.y, f.grid.spacing.z};
    const std::array<std::int64_t, 3> count = {f.grid.count[0], f.grid.count[1], f.grid.count[2]};
    write_attribute(set.get(), "origin", std::span<const double>(origin));
    write_attribute(set.get(), "spacing", std::span<const double>(spacing));
    write_attribute(set.get(), "count", std::span<const std::int64_t>(count));
    write_attribute(set.get(), "role", f.role);
    if (!f.quantity.empty()) write_attribute(set.get(), "quantity", f.quantity);
  }
}

/// The surfaces of the bodies that are there, where they are at `time`.
WallLayout write_wall_group(hid_t file, const bodies::BodySet& bodies, sdk::Vec3 min, sdk::Vec3 max,
                            double time) {
  std::vector<float> points;
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> body_of;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].is_removed()) continue;
    std::map<std::array<float, 3>, std::int32_t> known;
    const double edge = bodies::written_edge(min, max);
    const bodies::Placement at = bodies[b].placement(bodies[b].displaces() ? time : 0.0);
    for (const sdk::Vec3& corner : bodies[b].triangles(min, max, edge, at)) {
      const std::array<float, 3> p = {static_cast<float>(corner.x), static_cast<float>(corner.y),
                                      static_cast<float>(corner.z)};
      const auto next = static_cast<std::int32_t>(points.size() / 3);
      const auto [place, is_new] = known.emplace(p, next);
      if (is_new) points.insert(points.end(), p.begin(), p.end());
      triangles.push_back(place->second);
    }
    body_of.resize(triangles.size() / 3, static_cast<std::int32_t>(b));
  }
  Handle group = create_group(file, "walls");
  write_array(group.get(), "points", H5T_NATIVE_FLOAT, points.data(), {points.size() / 3, 3},
              Storage::plain, {"m", "corners of the triangles"});
  write_array(group.get(), "triangles", H5T_NATIVE_INT32, triangles.data(), {body_of.size(), 3},
              Storage::plain, {"1", "three indices into points"});
  write_array(group.get(), "body", H5T_NATIVE_INT32, body_of.data(), {body_of.size()},
              Storage::plain, {"1", "index into the attribute names of /walls"});
  group.close("cannot write the walls");
  return {static_cast<std::int64_t>(points.size() / 3), static_cast<std::int64_t>(body_of.size())};
}

}  // namespace

const std::vector<FieldInfo>& particle_fields() {
  static const std::vector<FieldInfo> fields = {
      {"position", 3, "Float", 4, "m", "position of the centre"},
      {"velocity", 3, "Float", 4, "m/s", "velocity of the centre"},
      {"angular_velocity", 3, "Float", 4, "rad/s", "angular velocity"},
      {"force", 3, "Float", 4, "N", "contact, fluid and gravity force"},
      {"diameter", 1, "Float", 4, "m", "diameter"},
      {"weight", 1, "Float", 4, "1", "real grains per computed one"},
      {"mass", 1, "Float", 4, "kg", "mass of one real grain"},
      {"material", 1, "Int", 4, "1", "index into the root attribute material_names"},
      {"id", 1, "Int", 8, "1", "permanent number of the grain"}};
  return fields;
}

const std::vector<FieldInfo>& fluid_fields() {
  static const std::vector<FieldInfo> fields = {
      {"velocity", 3, "Float", 4, "m/s", "interstitial velocity at cell centres"},
      {"pressure", 1, "Float", 4, "Pa", "pressure without its hydrostatic part"},
      {"void_fraction", 1, "Float", 4, "1", "one minus solids over open volume"},
      {"momentum_exchange", 3, "Float", 4, "N/m3", "force of the grains on the fluid per volume"}};
  return fields;
}

std::string six_digits(std::int64_t number) {
  char text[32];
  std::snprintf(text, sizeof(text), "%06lld", static_cast<long long>(number));
  return text;
}

std::string frame_path(std::int64_t number) {
  return std::string(k_frame_folder) + "/" + six_digits(number) + ".h5";
}

FrameEntry write_frame(const fs::path& folder, const Frame& frame) {
  const fs::path file = folder / frame_path(frame.number);
  Handle out = create_file(temporary_name(file));
  write_attribute(out.get(), "format", std::int64_t{1});
  write_particles(out.get(), frame.world.grains, frame.time);
  if (!layout_of(frame.world.fluid).is_empty()) {
    write_fluid(out.get(), frame.world.fluid, frame.momentum_exchange, frame.time,
                frame.bodies != nullptr);
    write_more_of_fluid(out.get(), frame.fluid_fields);
  }
  FrameEntry entry{frame.number, frame.time,
                   static_cast<std::int64_t>(frame.world.grains.id.size())};
  if (frame.bodies != nullptr) {
    entry.has_walls = true;
    entry.walls = write_wall_group(out.get(), *frame.bodies, frame.world.domain_min,
                                   frame.world.domain_max, frame.time);
  }
  entry.has_fields = !frame.fields.empty();
  if (entry.has_fields) write_fields(out.get(), frame.fields);
  out.close("cannot write " + file.string());
  move_into_place(file, false);
  return entry;
}

FrameEntry read_frame_entry(const fs::path& folder, std::int64_t number) {
  const Handle in = open_file(folder / frame_path(number));
  const Handle group = open_group(in.get(), "particles");
  FrameEntry entry{number, read_attribute(group.get(), "time").at(0),
                   static_cast<std::int64_t>(extents_of(group.get(), "id").at(0))};
  entry.has_walls = H5Lexists(in.get(), "walls", H5P_DEFAULT) > 0;
  entry.has_fields = H5Lexists(in.get(), "sensors", H5P_DEFAULT) > 0;
  if (entry.has_walls) {
    entry.walls.points = static_cast<std::int64_t>(extents_of(in.get(), "walls/points").at(0));
    entry.walls.triangles = static_cast<std::int64_t>(extents_of(in.get(), "walls/body").at(0));
  }
  return entry;
}

FluidLayout layout_of(const sdk::FluidColumns& f) {
  return {f.origin, f.spacing, {f.count[0], f.count[1], f.count[2]}, f.density, f.viscosity};
}

void write_layout(std::int64_t group, const FluidLayout& layout) {
  const std::array<double, 3> origin = {layout.origin.x, layout.origin.y, layout.origin.z};
  const std::array<double, 3> spacing = {layout.spacing.x, layout.spacing.y, layout.spacing.z};
  const std::array<std::int64_t, 3> count = {layout.count[0], layout.count[1], layout.count[2]};
  write_attribute(group, "origin", std::span<const double>(origin));
  write_attribute(group, "spacing", std::span<const double>(spacing));
  write_attribute(group, "count", std::span<const std::int64_t>(count));
  write_attribute(group, "density", layout.density);
  write_attribute(group, "viscosity", layout.viscosity);
}

void write_open_fraction(const fs::path& folder, const sdk::FluidColumns& f) {
  const fs::path file = folder / k_open_fraction_path;
  const FluidLayout layout = layout_of(f);
  Handle out = create_file(temporary_name(file));
  Handle group = create_group(out.get(), "fluid");
  write_layout(group.get(), layout);
  write_array(group.get(), "open_fraction", H5T_NATIVE_FLOAT, f.open_fraction.data(),
              {static_cast<hsize_t>(layout.count[2]), static_cast<hsize_t>(layout.count[1]),
               static_cast<hsize_t>(layout.count[0])},
              Storage::compressed, {"1", "share of the cell not inside a body"});
  group.close("cannot write " + file.string());
  out.close("cannot write " + file.string());
  move_into_place(file, false);
}

FluidLayout read_fluid_layout(const fs::path& folder) {
  if (!fs::exists(folder / k_open_fraction_path)) return {};
  const Handle in = open_file(folder / k_open_fraction_path);
  const Handle group = open_group(in.get(), "fluid");
  FluidLayout layout;
  const std::vector<double> origin = read_attribute(group.get(), "origin");
  const std::vector<double> spacing = read_attribute(group.get(), "spacing");
  const std::vector<double> count = read_attribute(group.get(), "count");
  for (int d = 0; d < 3; ++d) {
    layout.origin[d] = origin.at(d);
    layout.spacing[d] = spacing.at(d);
    layout.count[d] = static_cast<int>(count.at(d));
  }
  layout.density = read_attribute(group.get(), "density").at(0);
  layout.viscosity = read_attribute(group.get(), "viscosity").at(0);
  return layout;
}

WallLayout write_walls(const fs::path& folder, const bodies::BodySet& bodies, sdk::Vec3 min,
                       sdk::Vec3 max) {
  const fs::path file = folder / k_walls_path;
  Handle out = create_file(temporary_name(file));
  const WallLayout layout = write_wall_group(out.get(), bodies, min, max, 0.0);
  out.close("cannot write " + file.string());
  move_into_place(file, false);
  return layout;
}

}  // namespace dust::io
