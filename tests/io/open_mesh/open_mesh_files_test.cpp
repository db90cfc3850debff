// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "encase/arrangement.hpp"
#include "encase/open_mesh.hpp"
#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

namespace fs = std::filesystem;
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

class OpenMeshFiles : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::path(testing::TempDir()) / ("encase-mesh-" + std::to_string(getpid()));
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  fs::path directory_;
};

double area(const Mesh& mesh, Mesh::FaceHandle face) {
  double twice = 0;
  for (const auto halfedge : mesh.fh_range(face)) {
    const auto p = mesh.point(mesh.from_vertex_handle(halfedge));
    const auto q = mesh.point(mesh.to_vertex_handle(halfedge));
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

TEST_F(OpenMeshFiles, ReadBackAsADiscInEveryFormat) {
  const Encasement e = sample::circle_and_line();
  for (const char* extension : {".om", ".off", ".obj", ".ply", ".OFF"}) {
    SCOPED_TRACE(extension);
    const std::string file = path(std::string("cells") + extension);
    const Status status = write_open_mesh(e, file);
    ASSERT_FALSE(status) << status->message;
    Mesh mesh;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, file));
    EXPECT_EQ(mesh.n_faces(), 3u);
    EXPECT_EQ(mesh.n_vertices(), 8u);
    EXPECT_EQ(mesh.n_edges(), 10u);  // Euler's characteristic is 1
    int boundary = 0;
    for (const auto edge : mesh.edges()) boundary += mesh.is_boundary(edge);
    EXPECT_EQ(boundary, 7);  // nothing open inside
    EXPECT_EQ(mesh.valence(mesh.face_handle(0)), 5u);
    double sum = 0;
    for (const auto face : mesh.faces()) {
      EXPECT_GT(area(mesh, face), 0);
      sum += area(mesh, face);
    }
    EXPECT_NEAR(sum, 4, 1e-6);
  }
}

TEST_F(OpenMeshFiles, KeepExactPointsAndPropertiesInTheirOwnFormat) {
  Encasement e = sample::circle_and_line();
  e.cells[1].state = CellState::Relaxed;
  ASSERT_FALSE(write_open_mesh(e, path("cells.om")));
  Mesh mesh;
  // Properties are read into properties that are there.
  OpenMesh::FPropHandleT<int> cell, state;
  mesh.add_property(cell, "cell");
  mesh.add_property(state, "state");
  ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, path("cells.om")));
  ASSERT_EQ(mesh.n_faces(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(mesh.property(cell, mesh.face_handle(k)), k);
    EXPECT_EQ(mesh.property(state, mesh.face_handle(k)), k == 1 ? 1 : 0);
  }
  bool found = false;
  for (const auto vertex : mesh.vertices())
    found |= mesh.point(vertex) == Mesh::Point(0.0625, 0.9, 0);
  EXPECT_TRUE(found);
}

/// A mesh with the properties of its faces.
struct MeshWithProperties {
  explicit MeshWithProperties(const std::string& file) {
    // Properties are read into properties that are there.
    mesh.add_property(cell, "cell");
    mesh.add_property(state, "state");
    mesh.add_property(face, "face");
    mesh.add_property(signs, "signs");
    EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, file));
  }
  Mesh mesh;
  OpenMesh::FPropHandleT<int> cell, state, face;
  OpenMesh::FPropHandleT<std::vector<int>> signs;
};

TEST_F(OpenMeshFiles, TellTheSignsAndTheFaceOfACell) {
  const Encasement e = sample::circle_and_line();
  ASSERT_FALSE(write_open_mesh(e, path("cells.om")));
  const MeshWithProperties m(path("cells.om"));
  ASSERT_EQ(m.mesh.n_faces(), 3u);
  for (const int k : {0, 1}) {
    EXPECT_EQ(m.mesh.property(m.face, m.mesh.face_handle(k)), -1);
    EXPECT_EQ(m.mesh.property(m.signs, m.mesh.face_handle(k)), (std::vector<int>{0, 0}));
  }
  const Arrangement a = arrange(e).value();
  EXPECT_EQ(m.mesh.property(m.face, m.mesh.face_handle(2)), a.pieces.back().face);
  EXPECT_EQ(m.mesh.property(m.signs, m.mesh.face_handle(2)), (std::vector<int>{1, 1}));
  // Signs are known in a certified cell though the arrangement is not.
  Encasement undecided = e;
  undecided.outcome = Outcome::Undecided;
  undecided.cells[0].state = CellState::Undecided;
  ASSERT_FALSE(write_open_mesh(undecided, path("undecided.om"), {true}));
  const MeshWithProperties u(path("undecided.om"));
  EXPECT_EQ(u.mesh.property(u.face, u.mesh.face_handle(2)), -1);
  EXPECT_EQ(u.mesh.property(u.signs, u.mesh.face_handle(2)), (std::vector<int>{1, 1}));
}

TEST_F(OpenMeshFiles, HoldThePiecesOfFaces) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  ASSERT_FALSE(write_open_mesh(e, path("faces.om"), {true}));
  const MeshWithProperties m(path("faces.om"));
  ASSERT_EQ(m.mesh.n_faces(), 9u);
  EXPECT_EQ(static_cast<int>(m.mesh.n_vertices()) - static_cast<int>(m.mesh.n_edges()) +
                static_cast<int>(m.mesh.n_faces()),
            1);
  double disc = 0, all = 0;
  for (const auto face : m.mesh.faces()) {
    const int id = m.mesh.property(m.face, face);
    ASSERT_GT(id, 0);
    std::vector<int> signs;
    for (const Sign sign : a.faces[id].signs) signs.push_back(static_cast<int>(sign));
    EXPECT_EQ(m.mesh.property(m.signs, face), signs);
    EXPECT_EQ(m.mesh.property(m.cell, face), a.pieces[face.idx()].cell);
    EXPECT_EQ(m.mesh.property(m.state, face), 0);
    EXPECT_GT(area(m.mesh, face), 0);
    all += area(m.mesh, face);
    if (signs[0] < 0) disc += area(m.mesh, face);
  }
  EXPECT_NEAR(all, 4, 1e-12);
  EXPECT_NEAR(disc, std::acos(-1.0) / 2, 1e-3);
  // Across an edge inside, another face or another cell.
  for (const auto edge : m.mesh.edges()) {
    if (m.mesh.is_boundary(edge)) continue;
    const auto left = m.mesh.face_handle(m.mesh.halfedge_handle(edge, 0)),
               right = m.mesh.face_handle(m.mesh.halfedge_handle(edge, 1));
    EXPECT_NE(m.mesh.property(m.cell, left) == m.mesh.property(m.cell, right),
              m.mesh.property(m.face, left) == m.mesh.property(m.face, right));
  }
  for (const char* name : {"faces.off", "faces.obj", "faces.ply"}) {
    ASSERT_FALSE(write_open_mesh(e, path(name), {true}));
    Mesh mesh;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, path(name)));
    EXPECT_EQ(mesh.n_faces(), 9u) << name;
  }
}

TEST_F(OpenMeshFiles, RefuseOtherExtensions) {
  const Encasement e = sample::circle_and_line();
  Status status = write_open_mesh(e, path("cells.stl"));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, Error::Code::BadInput);
  EXPECT_NE(status->message.find("STL holds triangles only"), std::string::npos);
  for (const char* name : {"cells", "cells.", ".off", "cells.txt"}) {
    status = write_open_mesh(e, path(name));
    ASSERT_TRUE(status) << name;
    EXPECT_EQ(status->code, Error::Code::BadInput);
  }
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(OpenMeshFiles, AreWrittenInSilence) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_FALSE(write_open_mesh(sample::circle_and_line(), path("cells.obj")));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(OpenMeshFiles, LeaveNothingBehindOnFailure) {
  const Encasement e = sample::circle_and_line();
  Status status = write_open_mesh(e, path("no/cells.off"));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, Error::Code::Io);
  Encasement broken = e;
  broken.cells[0] = broken.cells[1];
  status = write_open_mesh(broken, path("cells.off"));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, Error::Code::Internal);
  EXPECT_TRUE(fs::is_empty(directory_));
}

}  // namespace
}  // namespace encase
