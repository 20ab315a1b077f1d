#include "io/object_reader.hpp"

#include <fnmatch.h>

#include <numbers>
#include <set>

#include "io/resource_path.hpp"
#include "io/text.hpp"

#include "mamo/io/mesh.hpp"
#include "mamo/common/nearest_name.hpp"
#include "mamo/io/profile.hpp"

namespace mamo::io {
namespace {

const std::vector<std::string> kConstraintKeys = {"max_tilt",          "max_tilt_deg",     "max_speed",
                                                  "may_leave_support", "max_displacement", "touch"};

Touch read_touch(const YamlValue& value, const std::string& what, ObjectKind kind, Complaints& complaints) {
  const std::string name = read_text(value, what, complaints);
  const std::optional<Touch> touch = parse_touch(name);
  if (touch && (*touch != Touch::support || kind == ObjectKind::fixture)) return *touch;
  complaints.add(value, what + " is " + in_quotes(name) +
                            (touch ? ", but only a fixture can be a support"
                                   : ", expected allowed, robot, objects, forbidden or (fixtures) support"));
  return Touch::forbidden;
}

/// Numbers given in the map replace those of `c`.
void override_constraints(StrictMap& map, ObjectKind kind, InteractionConstraints& c, Complaints& complaints) {
  if (map.has("max_tilt") && map.has("max_tilt_deg")) map.complain(map.what() + " give both max_tilt and max_tilt_deg");
  c.max_tilt = map.number("max_tilt", c.max_tilt, kLimit);
  if (map.has("max_tilt_deg")) c.max_tilt = map.number("max_tilt_deg", 0, kLimit) * (std::numbers::pi / 180);
  c.max_speed = map.number("max_speed", c.max_speed, kLimit);
  c.may_leave_support = map.truth("may_leave_support", c.may_leave_support);
  c.max_displacement = map.number("max_displacement", c.max_displacement, kLimit);
  if (const YamlValue* touch = map.find("touch")) c.touch = read_touch(*touch, map.name_of("touch"), kind, complaints);
}

Shape read_mesh(const YamlValue& value, const std::string& what, const ObjectContext& context, Complaints& complaints) {
  const Shape none = Sphere{0.01};
  StrictMap map(value, "mesh of " + what, {"file", "scale"}, complaints);
  const std::string file = map.need_text("file");
  Eigen::Vector3d scale(1, 1, 1);
  const NumberRule positive{1e-9, 1e9, false, "a positive scale"};
  if (const YamlValue* s = map.find("scale")) {
    if (s->is_list())
      scale = read_numbers(*s, 3, map.name_of("scale"), positive, complaints);
    else
      scale.setConstant(read_number(*s, map.name_of("scale"), positive, complaints));
  }
  if (complaints.any()) return none;
  const bool is_uri = file.find("://") != std::string::npos;
  const Result<std::string> found =
      is_uri ? resolve_resource(file, context.path, context.package_path) : find_data_file(file, context.path);
  if (!found) return complaints.add(value, map.what() + ": " + found.error().message), none;
  const Result<LoadedHull> loaded = load_hull(*found, scale);
  if (!loaded) return complaints.add(value, map.what() + ": " + loaded.error().message), none;
  if (loaded->growth > 0.001)
    complaints.warn(value, map.what() + ": its hull was simplified and reaches up to " +
                               shortest_number(loaded->growth) + " m further out");
  return Mesh{loaded->hull};
}

Shape read_shape(const YamlValue& value, const std::string& what, const ObjectContext& context,
                 Complaints& complaints) {
  StrictMap map(value, "shape of " + what, {"box", "cylinder", "sphere", "mesh"}, complaints);
  if (value.members.size() != 1) map.complain(map.what() + " needs exactly one of box, cylinder, sphere, mesh");
  if (const YamlValue* box = map.find("box")) {
    StrictMap sizes(*box, "box of " + what, {"size"}, complaints);
    return Box{read_numbers(sizes.need("size"), 3, sizes.name_of("size"), kLength, complaints)};
  }
  if (const YamlValue* cylinder = map.find("cylinder")) {
    StrictMap sizes(*cylinder, "cylinder of " + what, {"radius", "length"}, complaints);
    return Cylinder{sizes.need_number("radius", kLength), sizes.need_number("length", kLength)};
  }
  if (const YamlValue* sphere = map.find("sphere")) {
    StrictMap sizes(*sphere, "sphere of " + what, {"radius"}, complaints);
    return Sphere{sizes.need_number("radius", kLength)};
  }
  if (const YamlValue* mesh = map.find("mesh")) return read_mesh(*mesh, what, context, complaints);
  return Sphere{0.01};
}

std::vector<PlacedShape> read_shapes(StrictMap& map, const ObjectContext& context, Complaints& complaints) {
  const YamlValue* one = map.find("shape");
  const YamlValue* many = map.find("shapes");
  if ((one != nullptr) == (many != nullptr)) {
    map.complain(map.what() + " needs either 'shape' or 'shapes'");
    return {};
  }
  if (one) return {{read_shape(*one, map.what(), context, complaints), Eigen::Isometry3d::Identity()}};
  if (!many->is_list() || many->items.empty()) {
    complaints.add(*many, map.name_of("shapes") + " must be a list of at least one {shape, pose}");
    return {};
  }
  std::vector<PlacedShape> shapes;
  for (std::size_t i = 0; i < many->items.size(); ++i) {
    const std::string what = "shape " + std::to_string(i) + " of " + map.what();
    StrictMap part(many->items[i], what, {"shape", "pose"}, complaints);
    PlacedShape placed{read_shape(part.need("shape"), what, context, complaints), Eigen::Isometry3d::Identity()};
    if (const YamlValue* pose = part.find("pose")) placed.X_BS = read_pose(*pose, part.name_of("pose"), complaints);
    shapes.push_back(placed);
  }
  return shapes;
}

ObjectKind read_kind(StrictMap& map, const std::string& id, const LoadOptions& options) {
  const bool fixture = map.truth("fixture", false), movable = map.truth("movable", false);
  if (fixture && movable) map.complain(map.what() + " is both fixture and movable");
  if (fixture) return ObjectKind::fixture;
  return movable || made_movable(id, options) ? ObjectKind::movable : ObjectKind::immovable;
}

double read_mass(StrictMap& map, ObjectKind kind, const LoadOptions& options, Complaints& complaints) {
  const YamlValue* given = map.find("mass");
  NumberRule rule = kMass;
  if (kind != ObjectKind::movable) rule.least = 0, rule.words = "a finite mass (0 to 1e6 kg)";
  double mass = given ? read_number(*given, map.name_of("mass"), rule, complaints) : 0.0;
  if (kind == ObjectKind::movable && !given) {
    if (!options.default_mass) map.complain(map.what() + " is movable and misses 'mass' (or give --default-mass)");
    mass = options.default_mass.value_or(1.0);
  }
  if (kind == ObjectKind::fixture && mass > 0) {
    complaints.warn(*given, map.name_of("mass") + " is ignored: a fixture does not move");
    mass = 0;
  }
  return mass;
}

Object read_object(const YamlValue& value, std::size_t index, const ObjectContext& context, Complaints& complaints) {
  Object object;
  const YamlValue* id = value.find("id");
  const std::string what =
      id && id->is_scalar() ? "object " + in_quotes(id->scalar) : "object " + std::to_string(index);
  StrictMap map(value, what,
                {"id", "shape", "shapes", "pose", "mass", "friction", "fixture", "movable", "touch", "constraints"},
                complaints);
  object.id = map.need_text("id");
  object.kind = read_kind(map, object.id, context.options);
  object.shapes = read_shapes(map, context, complaints);
  object.X_WO = read_pose(map.need("pose"), map.name_of("pose"), complaints);
  object.mass = read_mass(map, object.kind, context.options, complaints);
  object.friction = map.number("friction", context.options.default_friction.value_or(object.friction), kFriction);

  object.constraints = default_constraints(context.profile, object.kind);
  if (context.common && object.kind == ObjectKind::movable) {
    Complaints said_already(complaints.file());  // read_profile has checked this map
    StrictMap common(*context.common, "constraints", {}, said_already);
    override_constraints(common, object.kind, object.constraints, said_already);
  }
  if (const YamlValue* own = map.find("constraints")) {
    const bool fixture = object.kind == ObjectKind::fixture;
    StrictMap numbers(*own, "constraints of " + what, fixture ? std::vector<std::string>{"touch"} : kConstraintKeys,
                      complaints);
    override_constraints(numbers, object.kind, object.constraints, complaints);
    if (map.has("touch") && numbers.has("touch")) map.complain(what + " gives 'touch' twice");
  }
  if (const YamlValue* touch = map.find("touch"))
    object.constraints.touch = read_touch(*touch, map.name_of("touch"), object.kind, complaints);
  return object;
}

}  // namespace

Profile read_profile(const YamlValue* constraints, const LoadOptions& options, Complaints& complaints) {
  Profile profile = Profile::contact_only;
  if (constraints) {
    std::vector<std::string> keys = kConstraintKeys;
    keys.insert(keys.begin(), "profile");
    StrictMap map(*constraints, "constraints", keys, complaints);
    if (const YamlValue* name = map.find("profile")) {
      const std::string text = read_text(*name, "constraints profile", complaints);
      if (const std::optional<Profile> known = parse_profile(text))
        profile = *known;
      else
        complaints.add(*name, "constraints profile is " + in_quotes(text) + ", expected contact-only, full or legacy");
    }
    InteractionConstraints unused;
    override_constraints(map, ObjectKind::movable, unused, complaints);
  }
  return options.constraints.empty() ? profile : parse_profile(options.constraints).value_or(profile);
}

std::vector<Object> read_objects(const YamlValue& list, const ObjectContext& context, Complaints& complaints) {
  std::vector<Object> objects;
  if (list.kind == YamlValue::Kind::null) return objects;
  if (!list.is_list()) {
    complaints.add(list, "objects must be a list");
    return objects;
  }
  std::set<std::string> ids;
  for (std::size_t i = 0; i < list.items.size() && !complaints.any(); ++i) {
    objects.push_back(read_object(list.items[i], i, context, complaints));
    const std::string& id = objects.back().id;
    if (id == "robot" || id == "floor")
      complaints.add(*list.items[i].find("id"), "the id " + in_quotes(id) + " is taken: results use it for the " + id);
    if (!ids.insert(id).second)
      complaints.add(*list.items[i].find("id"),
                     "a second object with the id " + in_quotes(id) + ", ids must be unique");
  }
  return objects;
}

bool made_movable(const std::string& id, const LoadOptions& options) {
  for (const std::string& glob : options.movable)
    if (::fnmatch(glob.c_str(), id.c_str(), 0) == 0) return true;
  return false;
}

}  // namespace mamo::io
