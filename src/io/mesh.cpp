#include "mamo/io/mesh.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <filesystem>

#include "io/convex_hull.hpp"

#include "mamo/io/load.hpp"

namespace mamo::io {
namespace {

constexpr std::size_t kLargestMesh = 256u << 20;  // bytes

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

/// The triangles of every mesh below the node, in the frame of the scene; corners that no face uses are left out.
void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, TriangleMesh& out) {
  const aiMatrix4x4 X = parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    std::vector<int> index_of(mesh.mNumVertices, -1);
    const auto index = [&](unsigned v) {
      if (index_of[v] < 0) {
        const aiVector3D p = X * mesh.mVertices[v];
        index_of[v] = static_cast<int>(out.vertices.size());
        out.vertices.emplace_back(p.x, p.y, p.z);
      }
      return index_of[v];
    };
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];  // points and lines are no surface
      for (unsigned i = 2; i < face.mNumIndices; ++i)
        out.triangles.push_back({index(face.mIndices[0]), index(face.mIndices[i - 1]), index(face.mIndices[i])});
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) collect(scene, *node.mChildren[c], X, out);
}

/// assimp reports over several lines at times; ours is one.
std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return text;
}

}  // namespace

Result<TriangleMesh> load_triangles(const std::string& path, const Eigen::Vector3d& scale) {
  if (!scale.allFinite() || (scale.array() == 0).any()) return Error{path + ": mesh scale must be finite and not zero"};
  const std::string extension = lower_extension(path);
  if (extension != "stl" && extension != "obj" && extension != "dae")
    return Error{path + ": unsupported mesh format '." + extension + "', expected .stl, .obj or .dae"};
  Result<std::string> bytes = read_file(path, kLargestMesh);
  if (!bytes) return bytes.error();
  if (bytes->empty()) return Error{path + ": empty mesh file"};

  Assimp::Importer importer;  // owns the scene
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFileFromMemory(bytes->data(), bytes->size(), 0, extension.c_str());
  if (!scene || !scene->mRootNode)
    return Error{path + ": not a readable " + extension + " mesh: " + one_line(importer.GetErrorString())};
  TriangleMesh mesh;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), mesh);
  if (mesh.triangles.empty()) return Error{path + ": mesh without triangles"};
  for (Eigen::Vector3d& p : mesh.vertices) {
    if (!p.allFinite()) return Error{path + ": mesh with a coordinate that is not finite"};
    p = p.cwiseProduct(scale);
  }
  return mesh;
}

Result<LoadedHull> load_hull(const std::string& path, const Eigen::Vector3d& scale) {
  const Result<TriangleMesh> mesh = load_triangles(path, scale);
  if (!mesh) return mesh.error();
  std::optional<ConvexHull> full = convex_hull(mesh->vertices);
  if (!full) return Error{path + ": mesh has no volume"};
  SimplifiedHull simplified = simplify(*full);
  simplified.hull.source = path;
  simplified.hull.scale = scale;
  return LoadedHull{std::make_shared<const ConvexHull>(std::move(simplified.hull)), simplified.growth};
}

}  // namespace mamo::io
