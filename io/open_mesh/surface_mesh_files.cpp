// SPDX-License-Identifier: MIT
#include "encase/surface_mesh_file.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <string>
#include <vector>

#include "io/open_mesh/mesh_file.hpp"

namespace encase {
namespace {

using Mesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// What the triangles say of themselves.
struct Properties {
  explicit Properties(Mesh* mesh) {
    mesh->add_property(surface, "surface");
    mesh->add_property(cell, "cell");
    mesh->add_property(distance, "distance");
    mesh->add_property(angle, "angle");
    mesh->property(surface).set_persistent(true);
    mesh->property(cell).set_persistent(true);
    mesh->property(distance).set_persistent(true);
    mesh->property(angle).set_persistent(true);
  }
  OpenMesh::FPropHandleT<int> surface, cell;
  OpenMesh::FPropHandleT<double> distance, angle;
};

Status add(const SurfaceMesh& surface, const Properties& properties, Mesh* mesh) {
  std::vector<Mesh::VertexHandle> vertices;
  for (std::size_t k = 0; k < surface.points.size(); ++k) {
    const Point<3>&p = surface.points[k], &n = surface.normals[k];
    vertices.push_back(mesh->add_vertex({p[0], p[1], p[2]}));
    mesh->set_normal(vertices.back(), {n[0], n[1], n[2]});
  }
  for (std::size_t k = 0; k < surface.triangles.size(); ++k) {
    const auto& [a, b, c] = surface.triangles[k];
    const Mesh::FaceHandle face = mesh->add_face(vertices[a], vertices[b], vertices[c]);
    if (!face.is_valid())
      return Error{Error::Code::Internal,
                   "triangle " + std::to_string(k) + " cannot be added to the mesh"};
    mesh->property(properties.surface, face) = surface.surface;
    mesh->property(properties.cell, face) = surface.cells[k];
    mesh->property(properties.distance, face) = surface.distances[k];
    mesh->property(properties.angle, face) = surface.angles[k];
  }
  return {};
}

}  // namespace

Status write_open_mesh(const std::vector<SurfaceMesh>& meshes, const std::string& path) {
  const auto format = mesh_format(path);
  if (!format) return format.error();
  const Silence silence;
  Mesh mesh;
  mesh.request_vertex_normals();
  const Properties properties(&mesh);
  for (const SurfaceMesh& surface : meshes)
    if (Status bad = add(surface, properties, &mesh)) return bad;
  return write_mesh_file(mesh, OpenMesh::IO::Options::VertexNormal, format.value(), path);
}

}  // namespace encase
