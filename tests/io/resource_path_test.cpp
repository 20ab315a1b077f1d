#include "io/resource_path.hpp"

#include <gmock/gmock.h>

#include "support/scratch_folder.hpp"

namespace mamo::io {
namespace {

using testing::HasSubstr;

/// An environment variable that is put back afterwards.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::optional<std::string> old_;
};

class ResourcePath : public testing::Test {
 protected:
  std::string resolve(const std::string& uri, const std::map<std::string, std::string>& packages = {}) {
    const auto found = resolve_resource(uri, urdf_, packages);
    return found ? *found : found.error().message;
  }
  test::ScratchFolder folder_;
  std::string urdf_ = folder_.write("arm_description/urdf/arm.urdf", "");
};

TEST_F(ResourcePath, RelativeAbsoluteAndFilePathsAreFound) {
  const std::string mesh = folder_.write("arm_description/urdf/meshes/a b.stl", "");
  EXPECT_EQ(resolve("meshes/a b.stl"), mesh);
  EXPECT_EQ(resolve("../urdf/./meshes/a b.stl"), mesh);
  EXPECT_EQ(resolve(mesh), mesh);
  EXPECT_EQ(resolve("file://" + folder_.path() + "/arm_description/urdf/meshes/a%20b.stl"), mesh);
}

TEST_F(ResourcePath, ExtensionsMatchWithoutCase) {
  const std::string mesh = folder_.write("arm_description/urdf/hand.STL", "");
  EXPECT_EQ(resolve("hand.stl"), mesh);
  EXPECT_EQ(resolve("hand.Stl"), mesh);
  EXPECT_THAT(resolve("Hand.stl"), HasSubstr("not found"));
}

TEST_F(ResourcePath, PackagesAreLookedUpInTheDocumentedOrder) {
  const std::string beside = folder_.write("arm_description/urdf/arm_description/m.stl", "");
  EXPECT_EQ(resolve("package://arm_description/m.stl"), beside);
  const std::string pseudo = folder_.write("arm_description/urdf/m.stl", "");
  EXPECT_EQ(resolve("package://arm_description/m.stl"), pseudo);
  const std::string ancestor = folder_.write("arm_description/m.stl", "");
  EXPECT_EQ(resolve("package://arm_description/m.stl"), ancestor);
  const std::string ament = folder_.write("install/share/arm_description/m.stl", "");
  const Variable ament_path("AMENT_PREFIX_PATH", "/nowhere:" + folder_.path() + "/install");
  EXPECT_EQ(resolve("package://arm_description/m.stl"), ament);
  const std::string ros = folder_.write("ros/arm_description/m.stl", "");
  const Variable ros_path("ROS_PACKAGE_PATH", folder_.path() + "/ros:/nowhere");
  EXPECT_EQ(resolve("package://arm_description/m.stl"), ros);
  const std::string given = folder_.write("given/m.stl", "");
  EXPECT_EQ(resolve("package://arm_description/m.stl", {{"arm_description", folder_.path() + "/given"}}), given);
}

TEST_F(ResourcePath, APseudoPackageIsAFolderBesideTheUrdf) {
  const std::string mesh = folder_.write("arm_description/urdf/meshes/link1.stl", "");
  EXPECT_EQ(resolve("package://meshes/link1.stl"), mesh);
}

TEST_F(ResourcePath, FailureListsEveryPathTriedOnce) {
  const std::string root = folder_.path() + "/arm_description";
  EXPECT_EQ(resolve("package://arm_description/m.stl", {{"arm_description", "/given"}}),
            "'package://arm_description/m.stl' not found; tried /given/m.stl, " + root + "/m.stl, " + root +
                "/urdf/m.stl, " + root +
                "/urdf/arm_description/m.stl (--package-path NAME=DIR says where a package lies)");
  EXPECT_EQ(resolve("m.stl"), "'m.stl' not found; tried " + root + "/urdf/m.stl");
  EXPECT_THAT(resolve("package://arm_description"), HasSubstr("names no file in a package"));
  EXPECT_THAT(resolve("http://example.org/m.stl"), HasSubstr("unsupported scheme"));
}

}  // namespace
}  // namespace mamo::io
