// SPDX-License-Identifier: MIT
#include <limits>

#include "surface_json.hpp"

namespace encase {

namespace {

double number_or_infinity(const JsonNode& node) {
  return node.is_null() ? std::numeric_limits<double>::infinity() : node.number();
}

SurfaceMesh read_mesh(const JsonNode& node, const SurfaceEncasement& e) {
  SurfaceMesh mesh;
  mesh.surface = node.member("surface").index(e.surfaces.size());
  mesh.tolerance = node.member("tolerance").number();
  mesh.distance = number_or_infinity(node.member("distance"));
  mesh.angle = number_or_infinity(node.member("angle"));
  mesh.distance_to_mesh = number_or_infinity(node.member("distance_to_mesh"));
  mesh.euler = static_cast<int>(node.member("euler").integer(std::numeric_limits<int>::min(),
                                                             std::numeric_limits<int>::max()));
  mesh.within_tolerance = node.member("within_tolerance").boolean();
  mesh.isotopic = node.member("isotopic").boolean();
  mesh.apart = node.member("apart").boolean();
  mesh.complete = node.member("complete").boolean();
  const auto point = [](const JsonNode& item) { return item.point<3>(); };
  mesh.points = node.member("points").map(point);
  const int points = static_cast<int>(mesh.points.size());
  mesh.normals = node.member("normals").of_size(points).map(point);
  mesh.triangles = node.member("triangles").map([&](const JsonNode& item) {
    const std::vector<int> corners = item.of_size(3).indices(mesh.points.size());
    return std::array<int, 3>{corners[0], corners[1], corners[2]};
  });
  const int triangles = static_cast<int>(mesh.triangles.size());
  mesh.cells = node.member("cells").of_size(triangles).indices(e.cells.size());
  mesh.distances = node.member("distances").of_size(triangles).map(number_or_infinity);
  mesh.angles = node.member("angles").of_size(triangles).map(number_or_infinity);
  return mesh;
}

}  // namespace

void put_meshes(JsonWriter& w, const std::vector<SurfaceMesh>& meshes) {
  w.lines(meshes, [&](const SurfaceMesh& mesh) {
    w.raw("{");
    w.field("surface", mesh.surface);
    w.field("tolerance", mesh.tolerance);
    w.field("distance", mesh.distance);
    w.field("angle", mesh.angle);
    w.field("distance_to_mesh", mesh.distance_to_mesh);
    w.field("euler", mesh.euler);
    w.field("within_tolerance", mesh.within_tolerance);
    w.field("isotopic", mesh.isotopic);
    w.field("apart", mesh.apart);
    w.field("complete", mesh.complete);
    w.key("points"), w.list(mesh.points);
    w.key("normals"), w.list(mesh.normals);
    w.key("triangles"), w.list(mesh.triangles);
    w.key("cells"), w.list(mesh.cells);
    w.key("distances"), w.list(mesh.distances);
    w.key("angles"), w.list(mesh.angles);
    w.raw("}");
  });
}

std::vector<SurfaceMesh> read_meshes(const JsonNode& node, const SurfaceEncasement& encasement) {
  return node.map([&](const JsonNode& item) { return read_mesh(item, encasement); });
}

}  // namespace encase
