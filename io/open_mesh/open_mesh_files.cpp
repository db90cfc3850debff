// SPDX-License-Identifier: MIT
#include "encase/open_mesh.hpp"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <optional>
#include <string>
#include <vector>

#include "2d/cell_complex.hpp"
#include "2d/cell_signs.hpp"
#include "2d/piece_complex.hpp"
#include "2d/trace.hpp"
#include "encase/arrangement.hpp"
#include "io/open_mesh/mesh_file.hpp"

namespace encase {
namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// Between a curve and its polyline, as a part of the region's size.
constexpr double kTolerance = 1e-4;

Error error(Error::Code code, const std::string& message) { return {code, message}; }

/// What the faces of a mesh say of themselves.
struct Properties {
  explicit Properties(Mesh* mesh) {
    mesh->add_property(cell, "cell");
    mesh->add_property(state, "state");
    mesh->add_property(face, "face");
    mesh->add_property(signs, "signs");
    mesh->property(cell).set_persistent(true);
    mesh->property(state).set_persistent(true);
    mesh->property(face).set_persistent(true);
    mesh->property(signs).set_persistent(true);
  }
  OpenMesh::FPropHandleT<int> cell, state, face;
  OpenMesh::FPropHandleT<std::vector<int>> signs;
};

/// Adds a polygon of a cell, or of a part of it; nothing if it does not fit to those that are
/// there.
std::optional<Mesh::FaceHandle> add_polygon(const Encasement& encasement, int cell,
                                            const std::vector<int>& corners,
                                            const Properties& properties, Mesh* mesh) {
  std::vector<Mesh::VertexHandle> loop;
  for (const int k : corners) loop.push_back(mesh->vertex_handle(static_cast<unsigned>(k)));
  const Mesh::FaceHandle face = mesh->add_face(loop);
  if (!face.is_valid()) return std::nullopt;
  mesh->property(properties.cell, face) = cell;
  mesh->property(properties.state, face) = static_cast<int>(encasement.cells[cell].state);
  return face;
}

Error misfit(const char* what, std::size_t k) {
  return error(Error::Code::Internal,
               std::string(what) + " " + std::to_string(k) + " cannot be added to the mesh");
}

void add_points(const std::vector<Point<2>>& points, Mesh* mesh) {
  for (const Point<2>& p : points) mesh->add_vertex({p[0], p[1], 0});
}

/// The face of the arrangement in which each cell lies; -1 for several or none.
std::vector<int> faces_of_cells(const Encasement& encasement, const Arrangement* arrangement) {
  std::vector<int> faces(encasement.cells.size(), -1);
  if (!arrangement) return faces;
  for (const Arrangement::Piece& piece : arrangement->pieces)
    if (encasement.cells[piece.cell].word.empty()) faces[piece.cell] = piece.face;
  return faces;
}

Status add_cells(const Encasement& encasement, const Arrangement* arrangement, Mesh* mesh) {
  const Result<CellComplex> complex = make_cell_complex(encasement);
  if (!complex) return complex.error();
  add_points(complex.value().points, mesh);
  const Properties properties(mesh);
  const std::vector<int> faces = faces_of_cells(encasement, arrangement);
  CellSigns signs(encasement);
  for (std::size_t k = 0; k < encasement.cells.size(); ++k) {
    const auto face =
        add_polygon(encasement, static_cast<int>(k), complex.value().cells[k], properties, mesh);
    if (!face) return misfit("cell", k);
    mesh->property(properties.face, *face) = faces[k];
    mesh->property(properties.signs, *face) = signs.of(encasement.cells[k]);
  }
  return std::nullopt;
}

Status add_pieces(const Encasement& encasement, const Arrangement& arrangement, Mesh* mesh) {
  const double tolerance = kTolerance * encasement.region_used.bounding_box().largest_width();
  const Result<PieceComplex> complex =
      make_piece_complex(encasement, arrangement, trace_edges(encasement, arrangement, tolerance));
  if (!complex) return complex.error();
  add_points(complex.value().points, mesh);
  const Properties properties(mesh);
  for (std::size_t k = 0; k < arrangement.pieces.size(); ++k) {
    const Arrangement::Piece& piece = arrangement.pieces[k];
    const auto face =
        add_polygon(encasement, piece.cell, complex.value().pieces[k], properties, mesh);
    if (!face) return misfit("piece", k);
    mesh->property(properties.face, *face) = piece.face;
    std::vector<int>& signs = mesh->property(properties.signs, *face);
    for (const Sign sign : arrangement.faces[piece.face].signs)
      signs.push_back(static_cast<int>(sign));
  }
  return std::nullopt;
}

Status build(const Encasement& encasement, const OpenMeshOptions& options, Mesh* mesh) {
  const Result<Arrangement> arranged = arrange(encasement);
  if (arranged && options.faces) return add_pieces(encasement, arranged.value(), mesh);
  return add_cells(encasement, arranged ? &arranged.value() : nullptr, mesh);
}

}  // namespace

Status write_open_mesh(const Encasement& encasement, const std::string& path,
                       const OpenMeshOptions& options) {
  const auto format = mesh_format(path);
  if (!format) return format.error();
  const Silence silence;
  Mesh mesh;
  if (Status bad = build(encasement, options, &mesh)) return bad;
  return write_mesh_file(mesh, {}, format.value(), path);
}

}  // namespace encase
