// SPDX-License-Identifier: Apache-2.0
#include "io/xdmf.hpp"

#include "base/text.hpp"
#include "io/frame_file.hpp"

#include <functional>

namespace dust::io {
namespace {

std::string number(double value) { return base::shortest_text(value); }
std::string number(std::int64_t value) { return std::to_string(value); }

std::string triple(double a, double b, double c) {
  return number(a) + " " + number(b) + " " + number(c);
}

std::string data_item(const std::string& extents, const char* type, int bytes, const char* format,
                      const std::string& content) {
  return "<DataItem Dimensions=\"" + extents + "\" NumberType=\"" + type + "\" Precision=\"" +
         std::to_string(bytes) + "\" Format=\"" + format + "\">" + content + "</DataItem>";
}

std::string attribute(const FieldInfo& field, const char* centre, const std::string& item) {
  return std::string("<Attribute Name=\"") + field.name + "\" AttributeType=\"" +
         (field.components == 3 ? "Vector" : "Scalar") + "\" Center=\"" + centre + "\">" + item +
         "</Attribute>\n";
}

std::string extents_of_field(const std::string& extents, const FieldInfo& field) {
  return field.components == 3 ? extents + " 3" : extents;
}

/// A point without a cell; see the header.
std::string empty_grid(const char* name, const char* topology, const std::vector<FieldInfo>& fields,
                       sdk::Vec3 corner, double time) {
  std::string text =
      std::string("<Grid Name=\"") + name + "\" GridType=\"Uniform\"><Time Value=\"" +
      number(time) + "\"/>\n<Topology TopologyType=\"" + topology +
      "\" NumberOfElements=\"0\" NodesPerElement=\"1\"/>\n" + "<Geometry GeometryType=\"XYZ\">" +
      data_item("1 3", "Float", 4, "XML", triple(corner.x, corner.y, corner.z)) + "</Geometry>\n";
  for (const FieldInfo& field : fields) {
    text += attribute(field, "Node",
                      data_item(extents_of_field("1", field), field.type, field.bytes, "XML",
                                field.components == 3 ? "0 0 0" : "0"));
  }
  return text + "</Grid>\n";
}

std::string document(const char* name, const std::vector<FrameEntry>& frames,
                     const std::string& without_frames,
                     const std::function<std::string(const FrameEntry&)>& grid) {
  std::string text = std::string("<?xml version=\"1.0\" ?>\n") +
                     "<!-- Open with ParaView's \"XDMF Reader\". -->\n" +
                     "<Xdmf Version=\"2.0\">\n<Domain>\n<Grid Name=\"" + name +
                     "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const FrameEntry& frame : frames) text += grid(frame);
  if (frames.empty()) text += without_frames;
  return text + "</Grid>\n</Domain>\n</Xdmf>\n";
}

std::string grid_start(const char* name, double time) {
  return std::string("<Grid Name=\"") + name + "\" GridType=\"Uniform\"><Time Value=\"" +
         number(time) + "\"/>\n";
}

}  // namespace

std::string particles_xdmf(const std::vector<FrameEntry>& frames, sdk::Vec3 corner) {
  const std::vector<FieldInfo>& all = particle_fields();
  const std::vector<FieldInfo> attributes(all.begin() + 1, all.end());
  const auto empty = [&](double time) {
    return empty_grid("particles", "Polyvertex", attributes, corner, time);
  };
  return document("particles", frames, empty(0.0), [&](const FrameEntry& frame) {
    if (frame.grains == 0) return empty(frame.time);
    const std::string group = frame_path(frame.number) + ":/particles/";
    const std::string n = number(frame.grains);
    std::string text = grid_start("particles", frame.time) +
                       "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" + n +
                       "\" NodesPerElement=\"1\"/>\n<Geometry GeometryType=\"XYZ\">" +
                       data_item(n + " 3", "Float", 4, "HDF", group + "position") + "</Geometry>\n";
    for (const FieldInfo& field : attributes) {
      text += attribute(field, "Node",
                        data_item(extents_of_field(n, field), field.type, field.bytes, "HDF",
                                  group + field.name));
    }
    return text + "</Grid>\n";
  });
}

std::string fluid_xdmf(const std::vector<FrameEntry>& frames, const FluidLayout& layout,
                       sdk::Vec3 corner) {
  const auto empty = [&](double time) {
    return empty_grid("fluid", "Polyvertex", {}, corner, time);
  };
  // XDMF counts z, y, x; the mesh is given by its corner points, one more than cells.
  const std::string cells = std::to_string(layout.count[2]) + " " +
                            std::to_string(layout.count[1]) + " " + std::to_string(layout.count[0]);
  const std::string corners = std::to_string(layout.count[2] + 1) + " " +
                              std::to_string(layout.count[1] + 1) + " " +
                              std::to_string(layout.count[0] + 1);
  const sdk::Vec3 o = layout.origin;
  const sdk::Vec3 h = layout.spacing;
  return document("fluid", frames, empty(0.0), [&](const FrameEntry& frame) {
    if (layout.is_empty()) return empty(frame.time);
    std::string text = grid_start("fluid", frame.time) +
                       "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"" + corners +
                       "\"/>\n<Geometry GeometryType=\"ORIGIN_DXDYDZ\">" +
                       data_item("3", "Float", 8, "XML", triple(o.z, o.y, o.x)) +
                       data_item("3", "Float", 8, "XML", triple(h.z, h.y, h.x)) + "</Geometry>\n";
    const std::string group = frame_path(frame.number) + ":/fluid/";
    for (const FieldInfo& field : fluid_fields()) {
      text += attribute(field, "Cell",
                        data_item(extents_of_field(cells, field), field.type, field.bytes, "HDF",
                                  group + field.name));
    }
    const FieldInfo open = {"open_fraction", 1, "Float", 4, "1", ""};
    text += attribute(
        open, "Cell",
        data_item(cells, "Float", 4, "HDF",
                  (frame.has_walls ? frame_path(frame.number) : std::string(k_open_fraction_path)) +
                      ":/fluid/open_fraction"));
    return text + "</Grid>\n";
  });
}

std::string walls_xdmf(const std::vector<FrameEntry>& frames, const WallLayout& layout,
                       sdk::Vec3 corner) {
  const auto empty = [&](double time) { return empty_grid("walls", "Triangle", {}, corner, time); };
  return document("walls", frames, empty(0.0), [&](const FrameEntry& frame) {
    const WallLayout& walls = frame.has_walls ? frame.walls : layout;
    if (walls.triangles == 0) return empty(frame.time);
    const std::string group =
        (frame.has_walls ? frame_path(frame.number) : std::string(k_walls_path)) + ":/walls/";
    const std::string n = number(walls.triangles);
    const FieldInfo body = {"body", 1, "Int", 4, "1", ""};
    return grid_start("walls", frame.time) +
           "<Topology TopologyType=\"Triangle\" NumberOfElements=\"" + n + "\">" +
           data_item(n + " 3", "Int", 4, "HDF", group + "triangles") +
           "</Topology>\n<Geometry GeometryType=\"XYZ\">" +
           data_item(number(walls.points) + " 3", "Float", 4, "HDF", group + "points") +
           "</Geometry>\n" +
           attribute(body, "Cell", data_item(n, "Int", 4, "HDF", group + "body")) + "</Grid>\n";
  });
}

}  // namespace dust::io
