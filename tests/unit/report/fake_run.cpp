// SPDX-License-Identifier: Apache-2.0
#include "fake_run.hpp"

#include <hdf5.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace dust::test {

namespace {

using nlohmann::json;

template <typename T>
void put(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& sizes,
         const std::vector<T>& values) {
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  const hid_t space = H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
  const hid_t set = H5Dcreate2(file, path.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT);
  if (!values.empty()) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(links);
}

void put_attribute(hid_t file, const std::string& group, const char* name,
                   const std::vector<double>& values) {
  const hid_t node = H5Oopen(file, group.c_str(), H5P_DEFAULT);
  const hsize_t size = values.size();
  const hid_t space = size == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr);
  const hid_t attribute =
      H5Acreate2(node, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Oclose(node);
}

void put_texts(hid_t file, const std::string& group, const char* name,
               const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t size = pointers.size();
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  const hid_t node = H5Oopen(file, group.c_str(), H5P_DEFAULT);
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t attribute = H5Acreate2(node, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, pointers.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Oclose(node);
  H5Tclose(type);
}

std::string frame_name(const std::string& group, int number) {
  char name[16];
  std::snprintf(name, sizeof name, "%06d", number);
  return group + "/" + name;
}

void put_grains(hid_t file, int frame, const FakeRun& run) {
  const int count = run.coarse_grains + run.dust_grains;
  std::vector<float> position, diameter;
  std::vector<std::int64_t> id;
  for (int k = 0; k < count; ++k) {
    const bool is_dust = k >= run.coarse_grains;
    position.push_back(is_dust ? 0.25F : 0.5F);
    position.push_back(0.1F);
    position.push_back(is_dust ? 0.75F : 0.5F);
    diameter.push_back(is_dust ? 10e-6F : 500e-6F);
    id.push_back(1000 + k);
  }
  const auto n = static_cast<hsize_t>(count);
  const std::string path = frame_name("/particles", frame);
  put(file, path + "/position", H5T_NATIVE_FLOAT, {n, 3}, position);
  put(file, path + "/diameter", H5T_NATIVE_FLOAT, {n}, diameter);
  put(file, path + "/id", H5T_NATIVE_INT64, {n}, id);
  put_attribute(file, path, "time", {0.1 * frame});
}

/// A grid of 4 x 2 x 3 cells over the unit square; u = 2 m/s everywhere, the first cell is solid.
void put_air(hid_t file, int frame) {
  const std::string path = frame_name("/fluid", frame);
  std::vector<float> velocity, pressure;
  for (int k = 0; k < 24; ++k) {
    velocity.insert(velocity.end(), {2.0F, 0.0F, 0.0F});
    pressure.push_back(k < 12 ? -1.0F : 1.0F);
  }
  put(file, path + "/velocity", H5T_NATIVE_FLOAT, {3, 2, 4, 3}, velocity);
  put(file, path + "/pressure", H5T_NATIVE_FLOAT, {3, 2, 4}, pressure);
  put_attribute(file, path, "time", {0.1 * frame});
  if (frame > 0) return;
  std::vector<float> open(24, 1.0F);
  open[0] = open[4] = 0.0F;  // both rows of the depth at x = z = 0
  put(file, "/fluid/open_fraction", H5T_NATIVE_FLOAT, {3, 2, 4}, open);
  put_attribute(file, "/fluid", "origin", {0.0, 0.0, 0.0});
  put_attribute(file, "/fluid", "spacing", {0.25, 0.1, 1.0 / 3.0});
  put_attribute(file, "/fluid", "count", {4.0, 2.0, 3.0});
}

}  // namespace

json fake_figure(double value, const char* unit, double error) {
  return {{"value", value}, {"unit", unit}, {"uncertainty", error < 0.0 ? json() : json(error)}};
}

json with_role(json figure, const char* role, const char* quantity, const char* direction,
               double diameter) {
  figure["role"] = role;
  figure["quantity"] = quantity;
  if (*direction != '\0') figure["direction"] = direction;
  if (diameter > 0.0) figure["diameters_m"] = {diameter, diameter};
  return figure;
}

json fake_summary() {
  const auto quantile = [](double value, double error, double probability) {
    json figure = with_role(fake_figure(value, "m", error), "stream_quantile", "length");
    figure["probability"] = probability;
    figure["drop_m"] = 0.14;
    return figure;
  };
  return {
      {"scenario", "transfer_point"},
      {"version", "0.1.0"},
      {"status", "finished"},
      {"threads", 2},
      {"wall_s", 120.0},
      {"cpu_s", 210.0},
      {"peak_rss_bytes", 123000000},
      {"simulated_s", 0.7},
      {"dem_steps", 4321},
      {"fluid_steps", 700},
      {"particle_steps", 987654},
      {"particles",
       {{"emitted", 100}, {"in_domain", 45}, {"left", 50}, {"removed", 5}, {"max", 61}}},
      {"real_particles",
       {{"emitted", 90.5}, {"in_domain", 40.0}, {"left", 45.5}, {"removed", 5.0}, {"max", 54.0}}},
      {"mass_kg", {{"emitted", 0.25}, {"in_domain", 0.125}, {"left", 0.0625}, {"removed", 0.0625}}},
      {"timers_s", {{"contact", 60.0}, {"fluid", 40.0}, {"dem_cycle", 61.0}}},
      {"timer_groups", {{"dem_cycle", {"contact"}}, {"particles", {"contact"}}}},
      {"state_sha256", "0123456789abcdef"},
      {"sensors",
       {{"loose_dust",
         {{"liberated",
           with_role(fake_figure(0.01372, "g/t", 0.0021), "passage", "mass_per_load", "net")},
          {"grains", 57}}},
        {"stream",
         {{"middle", quantile(0.128404, 0.0003, 0.5)},
          {"near", quantile(0.1172, -1.0, 0.05)},
          {"far", quantile(0.1385, -1.0, 0.95)}}}}}};
}

RunFolder::RunFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "dust_report_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void RunFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

void RunFolder::write_h5(const FakeRun& run) const {
  const hid_t file =
      H5Fcreate((path_ / "results.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (int frame = 0; frame < run.frames; ++frame) {
    put_grains(file, frame, run);
    if (run.has_fluid) put_air(file, frame);
  }
  H5Fclose(file);
}

void RunFolder::write_tracks(const std::vector<std::vector<FakeGrain>>& frames) const {
  const hid_t file =
      H5Fcreate((path_ / "results.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    std::vector<float> position, velocity, diameter;
    std::vector<std::int64_t> id;
    for (const FakeGrain& grain : frames[frame]) {
      position.insert(position.end(), {static_cast<float>(grain.x), static_cast<float>(grain.y),
                                       static_cast<float>(grain.z)});
      velocity.insert(velocity.end(), {static_cast<float>(grain.speed), 0.0F, 0.0F});
      diameter.push_back(static_cast<float>(grain.diameter));
      id.push_back(grain.id);
    }
    const std::string path = frame_name("/particles", static_cast<int>(frame));
    const auto n = static_cast<hsize_t>(id.size());
    put(file, path + "/position", H5T_NATIVE_FLOAT, {n, 3}, position);
    put(file, path + "/velocity", H5T_NATIVE_FLOAT, {n, 3}, velocity);
    put(file, path + "/diameter", H5T_NATIVE_FLOAT, {n}, diameter);
    put(file, path + "/id", H5T_NATIVE_INT64, {n}, id);
    put_attribute(file, path, "time", {0.1 * static_cast<double>(frame)});
  }
  H5Fclose(file);
}

void RunFolder::write_surfaces(const std::vector<FakeSurface>& frames,
                               const std::vector<std::string>& names) const {
  const hid_t file =
      H5Fcreate((path_ / "results.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const FakeSurface& surface = frames[frame];
    const auto n = static_cast<int>(frame);
    const std::string walls = frame_name("/walls", n), grains = frame_name("/particles", n);
    put(file, walls + "/points", H5T_NATIVE_FLOAT, {surface.points.size() / 3, 3}, surface.points);
    put(file, walls + "/triangles", H5T_NATIVE_INT, {surface.body.size(), 3}, surface.triangles);
    put(file, walls + "/body", H5T_NATIVE_INT, {surface.body.size()}, surface.body);
    put(file, grains + "/position", H5T_NATIVE_FLOAT, {0, 3}, std::vector<float>{});
    put(file, grains + "/diameter", H5T_NATIVE_FLOAT, {0}, std::vector<float>{});
    put_attribute(file, grains, "time", {0.1 * n});
  }
  put_texts(file, "/walls", "names", names);
  H5Fclose(file);
}

std::string RunFolder::read(const std::string& name) const {
  std::ifstream stream(path_ / name, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

json page_data(const std::string& page) {
  const std::string mark = "<script type=\"application/json\" id=\"run-data\">";
  const auto from = page.find(mark);
  if (from == std::string::npos) return nullptr;
  const auto to = page.find("</script>", from);
  return json::parse(page.substr(from + mark.size(), to - from - mark.size()));
}

std::string unpacked(const std::string& base64) {
  static const std::string k_digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string zipped;
  unsigned bits = 0;
  int held = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(k_digits.find(c));
    held += 6;
    if (held >= 8) {
      held -= 8;
      zipped += static_cast<char>(bits >> held & 255);
    }
  }
  std::string bytes(1 << 20, '\0');
  uLongf size = bytes.size();
  if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                 reinterpret_cast<const Bytef*>(zipped.data()), zipped.size()) != Z_OK) {
    throw std::runtime_error("a blob of the page cannot be unpacked");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace dust::test
