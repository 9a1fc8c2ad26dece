#include "pipelines/text/scene_keys.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "pipelines/text/effect_table.hpp"
#include "pipelines/text/response_keys.hpp"

namespace microslip::pipelines {
namespace {

using enum KeyType;
using namespace keys;

/// Of E and ρ, with room for systems of units that nobody should use here.
constexpr double least_material = 1e-15;
constexpr double most_material = 1e20;

constexpr KeySpec length_key(std::string_view name, std::string_view preset,
                             std::string_view meaning) {
  return {name, number, "m", preset, 0.0, 10.0, true, meaning};
}

constexpr KeySpec kind_key{
    "kind", text, "", "", 0, 0, false, "blade | step | mesh | modes | modal | bar | chain | block"};
constexpr KeySpec order_key{"order", integer, "", "2", 2, 2, false, "order of the elements"};

/// A mesh file has its own.
constexpr KeySpec file_order_key{
    "order", integer, "", "", 1, 2, false, "order of the elements, as the file has it", true};

constexpr std::array blade_keys{
    kind_key,
    length_key("element_size", "\"4 mm\"", "target edge length of the mesh"),
    KeySpec{"edge_size", number, "m", "", 0.0, 10.0, true,
            "of elements at the outline of the foot and where root and aerofoil meet the platform",
            true},
    order_key,
    length_key("root_width", "\"6.6 mm\"", "root block along x (circumferential)"),
    length_key("root_height", "\"25 mm\"", "root block along y (radial); its foot lies in y = 0"),
    length_key("root_length", "\"50 mm\"", "root block along z (axial)"),
    length_key("platform_width", "\"60 mm\"",
               "platform along x; its right side face is the contact"),
    length_key("platform_height", "\"10 mm\"", "platform along y"),
    length_key("platform_length", "\"60 mm\"", "platform along z"),
    length_key("span", "\"114.1 mm\"", "aerofoil above the platform"),
    length_key("root_chord", "\"44 mm\"", "chord at the platform"),
    length_key("tip_chord", "\"34 mm\"", "chord at the tip"),
    length_key("root_thickness", "\"5 mm\"", "largest thickness of the section at the platform"),
    length_key("tip_thickness", "\"3 mm\"", "largest thickness of the section at the tip"),
    KeySpec{"root_stagger", number, "rad", "0.1", -1.5, 1.5, false,
            "angle of the chord to z about y at the platform"},
    KeySpec{"tip_stagger", number, "rad", "0.6", -1.5, 1.5, false, "the same at the tip"},
    KeySpec{"camber", number, "1", "0.04", -0.3, 0.3, false,
            "height of the camber line over the chord"},
    KeySpec{"lean", number, "m", "\"-3 mm\"", -1.0, 1.0, false, "shift of the tip section along x"},
};

constexpr std::array step_keys{
    kind_key,
    KeySpec{"file", text, "", "", 0, 0, false,
            "STEP file (.step, .stp) with one solid, relative to the scene"},
    KeySpec{
        "length_unit", other, "m", "", 0, 0, false,
        "unit of the file's coordinates, \"mm\" or metres per unit, where the file does not say "
        "it, or says another",
        true},
    length_key("element_size", "", "target edge length of the mesh"),
    order_key,
};

constexpr std::array face_keys{
    KeySpec{"point", other, "m", "", -unbounded, unbounded, false, "[x, y, z] on the face", true},
    KeySpec{"normal", direction, "", "", 0, 0, false,
            "outward normal of the face, in place of a point", true},
    KeySpec{"near", other, "m", "", -unbounded, unbounded, false,
            "[x, y, z] to which, of faces with that normal, it is the nearest", true},
    KeySpec{"number", integer, "", "", 1, 1'000'000, false,
            "of the face, as `microslip faces FILE` tells, in place of both", true},
    KeySpec{"size", number, "m", "", 0.0, 10.0, true, "of the elements on the face", true},
    KeySpec{"edge_size", number, "m", "", 0.0, 10.0, true, "of the elements at its edges", true},
};

constexpr std::array mesh_keys{
    kind_key,
    KeySpec{
        "file", text, "", "", 0, 0, false,
        "mesh, relative to the scene: gmsh (.msh 2.2 or 4.1), Abaqus or CalculiX (.inp), Nastran "
        "(.bdf .nas .fem), universal (.unv), MED (.med), VTK (.vtu .vtk), Exodus (.e .exo .ex2)"},
    KeySpec{"length_unit", other, "m", "", 0, 0, false,
            "unit of the file's coordinates: \"mm\", or metres per unit; may be left out for .msh "
            "(then "
            "m) and for files that tell it",
            true},
    KeySpec{"refinement", integer, "", "0", 0, 3, false,
            "times that each element of the file is cut along each edge: 1 makes eight of each"},
    KeySpec{"midside_nodes", text, "", "\"off\"", 0, 0, false,
            "on: linear elements get nodes in the middle of their edges, and are quadratic"},
    file_order_key,
};

constexpr std::array modes_model_keys{
    kind_key,
    KeySpec{"file", text, "", "", 0, 0, false,
            "modes of another code, relative to the scene: CalculiX (.frd of *FREQUENCY), Nastran "
            "(.pch), Code_Aster (.med), NumPy (.npz), a table (.csv)",
            true},
    KeySpec{"stiffness", text, "", "", 0, 0, false,
            "instead: K of another code, Matrix Market (.mtx), from which modes are solved here",
            true},
    KeySpec{"mass", text, "", "", 0, 0, false, "M of another code, Matrix Market (.mtx)", true},
    KeySpec{"nodes", text, "", "", 0, 0, false,
            "nodes of K and M (.csv): columns x, y, z, and ux, uy, uz: their rows from 1; 0: held",
            true},
    KeySpec{
        "mesh", text, "", "", 0, 0, false,
        "their mesh, any file that kind = \"mesh\" reads, of .pch the deck; else the .inp beside a "
        ".frd of that name, the .bdf beside a .pch, the .med itself",
        true},
    KeySpec{"length_unit", other, "m", "", 0, 0, false,
            "unit of the coordinates in both files: \"mm\", or metres per unit; may be left out "
            "where the mesh is .msh (then m)",
            true},
    KeySpec{"mass_unit", other, "kg", "", 0, 0, false,
            "in which the shapes are mass-normalised; else that of newtons and seconds: kg with "
            "metres, t with millimetres",
            true},
    KeySpec{"normalisation", text, "", "\"mass\"", 0, 0, false,
            "of the shapes: mass, or other (then rescaled by material.density)"},
};

constexpr std::array modal_model_keys{kind_key};

constexpr std::array bar_model_keys{
    kind_key,
    KeySpec{"youngs_modulus", number, "Pa", "", least_material, most_material, false, "E"},
    KeySpec{"area", number, "m^2", "", 0.0, unbounded, true, "A, cross-section"},
    KeySpec{"density", number, "kg/m^3", "", least_material, most_material, false, "ρ"},
    KeySpec{"length", number, "m", "", 0.0, unbounded, true,
            "L; the left end is x = 0, the right one is free"},
    KeySpec{"end_stiffness", other, "N/m", "\"clamped\"", 0, 0, false,
            "β, spring that holds the left end: a stiffness, \"clamped\", or 0 (free)"},
};

constexpr std::array chain_model_keys{
    kind_key,
    KeySpec{"coordinates", other, "", "", 0, 0, false,
            "names of the coordinates; else m1, m2, … in order", true},
    KeySpec{"masses", other, "kg", "", 0, 0, false,
            "a chain: m1 … mn (with springs; the alternatives are matrices, or modes)", true},
    KeySpec{"springs", other, "N/m", "", 0, 0, false,
            "a chain: ground–m1, m1–m2, …, and, if one more is given, mn–ground; 0: none", true},
    KeySpec{"mass_matrix", other, "kg", "", 0, 0, false, "any system: M, symmetric, a list of rows",
            true},
    KeySpec{"stiffness_matrix", other, "N/m", "", 0, 0, false,
            "any system: K, symmetric, a list of rows", true},
    KeySpec{"frequency", other, "Hz", "", 0, 0, false,
            "given modes: natural frequencies, one per mode", true},
    KeySpec{"mode_shapes", other, "1/kg^0.5", "", 0, 0, false,
            "given modes: one row per mode, mass-normalised, a number per coordinate", true},
};

constexpr std::array block_model_keys{
    kind_key,
    KeySpec{"mass", number, "kg", "", 0.0, unbounded, true,
            "of the block; vectors of this scene are told along p, q, r: q points out of the block "
            "into the ground"},
    KeySpec{"moments_of_inertia", other, "kg*m^2", "", 0.0, unbounded, false,
            "about p, q, r through the centre of mass: the principal axes"},
    KeySpec{"height", number, "m", "0", -unbounded, unbounded, false,
            "of the centre of mass above the contact plane"},
    KeySpec{"stiffness", other, "N/m", "", 0.0, unbounded, false,
            "springs at the centre of mass along p, q, r", true},
    KeySpec{"rotational_stiffness", other, "N*m", "", 0.0, unbounded, false,
            "springs that turn about p, q, r, per rad", true},
    KeySpec{"stiffness_matrix", other, "N/m", "", 0, 0, false,
            "6 x 6 instead, SI, of the displacements along p, q, r and the rotations about them, "
            "at the centre of mass",
            true},
};

constexpr std::array material_keys{
    KeySpec{"youngs_modulus", number, "Pa", "", least_material, most_material, false, "E"},
    KeySpec{"poissons_ratio", number, "1", "", -1.0, 0.4999, true, "ν"},
    KeySpec{"density", number, "kg/m^3", "", least_material, most_material, false, "ρ"},
};

constexpr std::array given_material_keys{
    KeySpec{"density", number, "kg/m^3", "", least_material, most_material, false,
            "ρ, where all of the mesh has one: checks the modes given, ΦᵀMΦ = 1", true},
};

constexpr std::array support_keys{
    KeySpec{"clamped", other, "", "[]", 0, 0, false,
            "names of surfaces, or sets of edges or nodes, that are held"},
};

constexpr KeySpec static_forces_key{
    "forces",
    other,
    "",
    "",
    0,
    0,
    false,
    "that do not vary, e.g. of a screw, for contact.preload = \"static\": a list of { at = …, "
    "direction = [x, y, z], amplitude = … }",
    true};
constexpr KeySpec static_pressure_key{
    "pressure",
    other,
    "",
    "",
    0,
    0,
    false,
    "on surfaces, for the same: a list of { surface = …, value = \"2 bar\" }, pushing into the "
    "body",
    true};

constexpr std::array static_keys{
    KeySpec{
        "speed", other, "rad/s", "", 0.0, unbounded, false,
        "of rotation, blade and supports together: \"3000 rpm\", \"50 Hz\" (turns per second) or "
        "rad/s. Modes are then those about the static equilibrium under the centrifugal load",
        true},
    KeySpec{"axis", other, "", "", 0, 0, false,
            "of rotation: { origin = [x, y, z], direction = [x, y, z] }; the origin is a point of "
            "it, default [0, 0, 0]",
            true},
    static_forces_key,
    static_pressure_key,
};

constexpr std::array given_static_keys{static_forces_key, static_pressure_key};  // with matrices

constexpr std::array static_force_keys{
    KeySpec{"at", other, "m", "", -unbounded, unbounded, false, "as that of a force"},
    KeySpec{"direction", direction, "", "", 0, 0, false, "global x, y, z"},
    KeySpec{"amplitude", number, "N", "", -unbounded, unbounded, false,
            "F, the whole force on the place, e.g. \"0.5 N\""},
};

constexpr std::array pressure_keys{
    KeySpec{"surface", text, "", "", 0, 0, false, "named surface of the mesh"},
    KeySpec{"value", number, "Pa", "", -unbounded, unbounded, false,
            "pressure into the body; below 0: suction"},
};

constexpr std::array axis_keys{
    KeySpec{"origin", other, "m", "[0, 0, 0]", -unbounded, unbounded, false,
            "a point of the axis, global x, y, z"},
    KeySpec{"direction", direction, "", "", 0, 0, false, "of the axis, global x, y, z"},
};

constexpr KeySpec damping_key{
    "damping_ratio",
    other,
    "1",
    "0.002",
    0,
    0,
    false,
    "one for all modes, a list with one each, or { alpha = …, beta = … } (C = αM + βK)"};

constexpr std::array mode_keys{
    KeySpec{"count", integer, "", "10", 1, 1000, false,
            "number of modes; where harmonics are chosen to less than 1 % as many more as reach 40 "
            "times the range, at most four times as many"},
    damping_key,
    KeySpec{"residual", text, "", "\"attachment\"", 0, 0, false,
            "omitted modes on the contact: attachment (static shapes; they take the last damping "
            "ratio of a "
            "list) | stiffness (in series with the contact, paper A; what a rigid contact takes) | "
            "none"},
    KeySpec{"attachment_degree", other, "", "\"auto\"", 0, 0, false,
            "of the tractions whose static shapes are added: 0, 1, 2 …, or \"auto\": the lowest "
            "that leaves no "
            "traction of the next degree more than 30 % of its residual flexibility short"},
    KeySpec{"solver", text, "", "\"direct\"", 0, 0, false,
            "direct | iterative (conjugate gradients with multigrid, where memory does not hold a "
            "factorisation: slower, and that no mode is missed is not proved)"},
};

constexpr std::array given_mode_keys{
    KeySpec{"count", integer, "", "", 1, 1000, false, "of the file, the first ones; else all",
            true},
    damping_key,
    KeySpec{"residual", text, "", "\"none\"", 0, 0, false,
            "omitted modes on the contact: none | attachment (static shapes, where the file has "
            "them); with matrices as in other scenes"},
    KeySpec{"attachment_degree", other, "", "", 0, 0, false,
            "with matrices: of the tractions whose static shapes are added", true},
};

constexpr std::array bar_mode_keys{
    KeySpec{"count", integer, "", "10", 1, 1000, false, "number of modes, the lowest ones"},
    KeySpec{"which", other, "", "", 0, 0, false,
            "the modes by number, whatever the count: [2] keeps the second alone", true},
    damping_key,
    KeySpec{"residual", text, "", "\"none\"", 0, 0, false,
            "omitted modes on the contact: stiffness | none"},
};

constexpr std::array chain_mode_keys{
    KeySpec{"count", integer, "", "", 1, 1000, false, "number of modes, the lowest ones; else all",
            true},
    damping_key,
};

constexpr KeySpec friction_key{"friction_coefficient", number, "1", "", 0.0, unbounded, false, "μ"};

constexpr std::array bar_contact_keys{
    KeySpec{"tangential_stiffness", number, "N/m^2", "", 0.0, unbounded, false,
            "per length of the bar"},
    friction_key,
    KeySpec{
        "load", other, "N/m", "", 0, 0, false,
        "normal force per length, constant in time: a number, or an expression in x and L such as "
        "\"2000*(0.2 + 0.8*(2*x/L - 1)^2)\""},
    KeySpec{"points", integer, "", "200", 1, 10'000'000, false, "contact points along the bar"},
};

constexpr std::array bar_excitation_keys{
    KeySpec{"force", number, "N", "", -unbounded, unbounded, false,
            "F in F sin θ along the bar, at its right end"},
};

constexpr std::array block_excitation_keys{
    KeySpec{"forces", other, "", "[]", 0, 0, false,
            "list of harmonic loads F sin(θ + phase), the phase in degrees"},
};

constexpr std::array block_force_keys{
    KeySpec{"at", other, "m", "[0, 0, 0]", -unbounded, unbounded, false,
            "point [p, q, r] where the force acts, from the centre of mass"},
    KeySpec{"force", other, "N", "[0, 0, 0]", -unbounded, unbounded, false,
            "amplitudes along p, q, r"},
    KeySpec{"moment", other, "N*m", "[0, 0, 0]", -unbounded, unbounded, false,
            "amplitudes about p, q, r"},
    KeySpec{"phase", number, "deg", "0", -unbounded, unbounded, false,
            "in degrees, as a number or as \"90 deg\""},
};

constexpr std::array block_output_keys{
    KeySpec{"at", other, "m", "[0, 0, 0]", -unbounded, unbounded, false,
            "point [p, q, r] from the centre of mass"},
    KeySpec{"direction", direction, "", "", 0, 0, false, "along p, q, r"},
};

constexpr std::array chain_contact_keys{
    KeySpec{"points", other, "", "[]", 0, 0, false, "contacts, a list of tables"},
};

constexpr std::array chain_contact_point_keys{
    KeySpec{"slip", other, "1", "", 0, 0, false,
            "coordinate that rubs, or a relative motion { m1 = 1, m2 = -1 }"},
    KeySpec{"approach", other, "1", "", 0, 0, false,
            "the same for the normal motion, positive when it closes", true},
    KeySpec{"tangential_stiffness", number, "N/m", "", 0.0, unbounded, false, "k_u of the contact"},
    KeySpec{"normal_stiffness", number, "N/m", "0", 0.0, unbounded, false, "k_v; 0: constant load"},
    friction_key,
    KeySpec{"share", number, "1", "1", 0.0, unbounded, false,
            "of the total preload, relative to the other contacts"},
    KeySpec{"cells", other, "", "[1, 1]", 0, 0, false,
            "an area instead of a point: cells along p (slip) and r"},
    KeySpec{"size", other, "m", "", 0.0, unbounded, true, "of the area along p and r", true},
    KeySpec{"preload_moment", other, "N*m", "[0, 0]", -unbounded, unbounded, false,
            "about p and r, given to the cells beside the force"},
};

constexpr std::array chain_force_keys{
    KeySpec{"at", text, "", "", 0, 0, false, "coordinate"},
    KeySpec{"amplitude", number, "N", "", -unbounded, unbounded, false, "F in F sin(θ + phase)"},
    KeySpec{"phase", number, "deg", "0", -unbounded, unbounded, false,
            "in degrees, as a number or as \"90 deg\""},
};

constexpr KeySpec roughness_key{
    "roughness",
    other,
    "m",
    "",
    0.0,
    unbounded,
    false,
    "rough surfaces: { law = \"cubic\" | \"gaussian\", height = \"10 um\" }, or a list of two",
    true};
constexpr KeySpec wear_key{"wear_coefficient",
                           number,
                           "m^2/N",
                           "0",
                           0.0,
                           unbounded,
                           false,
                           "Archard: depth per (pressure × slip distance)"};

constexpr std::array block_contact_keys{
    KeySpec{"cells", other, "", "[4, 4]", 0, 0, false, "along p and r"},
    KeySpec{"size", other, "m", "", 0.0, unbounded, false,
            "of the contact rectangle along p and r"},
    KeySpec{"centre", other, "m", "[0, 0]", -unbounded, unbounded, false,
            "of the rectangle along p and r, from below the centre of mass"},
    KeySpec{"normal_stiffness", number, "N/m", "", 0.0, unbounded, false,
            "of all cells together, in full contact; 0: constant load"},
    KeySpec{"tangential_stiffness", number, "N/m", "", 0.0, unbounded, false,
            "the same along p and along r"},
    KeySpec{"friction_coefficient", other, "1", "", 0.0, unbounded, false,
            "μ: a number, an expression in p and r [m] from the centre, { file = \"mu.csv\" } with "
            "columns p, r, value, or a law of the slip speed: { law = \"exponential\", static = …, "
            "kinetic = …, rate = \"… s/m\" } or "
            "{ law = \"hyperbolic\", static = …, rate = … }"},
    roughness_key,
    KeySpec{"preload_moment", other, "N*m", "[0, 0]", -unbounded, unbounded, false,
            "about p and r through the centre of the rectangle, beside each preload; cells may "
            "lift off"},
    wear_key,
};

constexpr std::array modal_contact_keys{
    KeySpec{"friction_law", other, "1", "", 0.0, unbounded, false,
            "of all points that rub, in place of their coefficient: { law = \"exponential\", "
            "static = …, "
            "kinetic = …, rate = \"… s/m\" }, { law = \"hyperbolic\", static = …, rate = … }, or, "
            "where the points have p and r, { expression = \"…\" }, { file = \"mu.csv\" }",
            true},
    roughness_key,
    wear_key,
};

constexpr std::array contact_keys{
    KeySpec{"surface", text, "", "", 0, 0, false,
            "named face that rubs; several: [[contact]] once for each, --set "
            "contact[0].KEY=… for one"},
    KeySpec{"name", text, "", "", 0, 0, false,
            "of columns and files where there are several contacts; else that of the surface",
            true},
    KeySpec{"preload_share", number, "1", "", 0.0, unbounded, true,
            "of each preload, relative to the other contacts, all of them or none; else by area",
            true},
    KeySpec{"slip_direction", direction, "", "[0, 0, 1]", 0, 0, false,
            "p axis, projected on the patch"},
    KeySpec{"friction_coefficient", other, "1", "", 0.0, unbounded, false,
            "μ: a number, an expression in p and r [m] from the centroid of the patch, { file = "
            "\"mu.csv\" } with "
            "columns p, r, value, or a law of the slip speed: { law = \"exponential\", static = …, "
            "kinetic = …, rate = \"… s/m\" } or "
            "{ law = \"hyperbolic\", static = …, rate = … }"},
    roughness_key,
    KeySpec{
        "preload", text, "", "", 0, 0, false,
        "\"static\": its shape and total are those of a contact that cannot pull, under the loads "
        "of [static], without friction; of all contacts or of none",
        true},
    KeySpec{
        "gap", number, "m", "", -unbounded, unbounded, false,
        "with preload = \"static\": between the bodies before the loads act; below 0: interference",
        true},
    KeySpec{"preload_field", other, "Pa", "\"uniform\"", -unbounded, unbounded, false,
            "shape of the preload, scaled to each total: \"uniform\", an expression in p and r, or "
            "{ file = … }; "
            "negative: a gap; a total is what the pressed part carries"},
    KeySpec{"preload_moment", other, "N*m", "[0, 0]", -unbounded, unbounded, false,
            "about p and r through the centroid, beside each preload; cells may lift off"},
    KeySpec{"normal_stiffness", other, "N/m^3", "", 0.0, unbounded, false,
            "local stiffness per area, or \"rigid\": the residual stiffness alone"},
    KeySpec{"tangential_stiffness", other, "N/m^3", "", 0.0, unbounded, false, "the same along p"},
    KeySpec{
        "fit", other, "", "\"auto\"", 0, 0, false,
        "degree of the fitted mode shapes, \"auto\", or \"none\" (finite-element interpolation, "
        "which \"auto\" takes where the fit is poor)"},
    wear_key,
    KeySpec{
        "points", integer, "", "", 1, 10'000'000, false,
        "least number of contact points; else 300, of several harmonics 90, or what the tolerance "
        "of chosen ones needs"},
};

constexpr std::array excitation_keys{
    KeySpec{"forces", other, "", "[]", 0, 0, false,
            "list of harmonic forces F sin(θ + phase), the phase in degrees"},
};

constexpr std::array force_keys{
    KeySpec{"at", other, "m", "", -unbounded, unbounded, false,
            "a name of the mesh (point, set or surface) or of [points], or coordinates [x, y, z]: "
            "the nearest node"},
    KeySpec{"direction", direction, "", "", 0, 0, false, "global x, y, z"},
    KeySpec{"amplitude", number, "N", "", -unbounded, unbounded, false,
            "F, the whole force on the place, e.g. \"0.5 N\""},
    KeySpec{"phase", number, "deg", "0", -unbounded, unbounded, false,
            "in degrees, as a number or as \"90 deg\""},
};

constexpr std::array gap_keys{
    KeySpec{"gap", number, "m", "", 0.0, unbounded, true, "uniform gap"},
};

constexpr std::array output_keys{
    KeySpec{"at", other, "m", "", -unbounded, unbounded, false,
            "as that of a force; of a set or surface the mean"},
    KeySpec{"direction", direction, "", "", 0, 0, false, "global x, y, z"},
};

constexpr std::array modal_keys{
    KeySpec{"frequency", other, "Hz", "", 0, 0, false, "natural frequencies, one per mode", true},
    KeySpec{"angular_frequency", other, "rad/s", "", 0, 0, false, "the same in rad/s, instead",
            true},
    KeySpec{"damping_ratio", other, "1", "", 0, 0, false, "one per mode, or one number"},
    KeySpec{"force_sine", other, "N/kg^0.5", "", 0, 0, false, "modal force amplitudes of sin θ"},
    KeySpec{"force_cosine", other, "N/kg^0.5", "0", 0, 0, false, "of cos θ"},
    KeySpec{"force_static", other, "N/kg^0.5", "0", 0, 0, false, "static modal force"},
    KeySpec{"output", other, "1/kg^0.5", "", 0, 0, false, "y = Σ output_m q_m"},
    KeySpec{"attachment", integer, "", "0", 0, 1000, false,
            "so many of the modes, the last, are static shapes that stand for omitted modes"},
    KeySpec{"points", other, "", "[]", 0, 0, false,
            "contact points: a CSV file, or a list of tables, with the columns"},
};

constexpr KeySpec point_column(std::string_view name, std::string_view unit,
                               std::string_view meaning, bool optional = true) {
  return {name, other, unit, "", 0, 0, false, meaning, optional};
}

constexpr std::array modal_point_keys{
    point_column("id", "", "number of the point, for its reader"),
    point_column("weight", "m^2", "area the point stands for; 1: the numbers of a point", false),
    point_column("tangential_stiffness", "N/m^3", "k_u along p, per weight", false),
    point_column("tangential_stiffness_r", "N/m^3", "k_w along r, per weight; else that along p"),
    point_column("normal_stiffness", "N/m^3", "k_v, per weight; 0: constant load", false),
    point_column("friction_coefficient", "1", "μ; 0: no friction", false),
    point_column("preload", "Pa",
                 "rest load, per weight; negative: a gap of -preload/normal_stiffness", false),
    point_column("residual_p", "m^3/N",
                 "flexibility of omitted modes along p, in series with the stiffness"),
    point_column("residual_q", "m^3/N", "the same along q"),
    point_column("residual_r", "m^3/N", "the same along r"),
    point_column("p", "m", "position along p, for maps"),
    point_column("r", "m", "position along r, for maps"),
    point_column("phi_u_N", "1/kg^0.5", "mode N along p: phi_u_1, phi_u_2, … one per mode", false),
    point_column("phi_v_N", "1/kg^0.5", "mode N along q, positive when it closes; else 0"),
    point_column("phi_w_N", "1/kg^0.5",
                 "mode N along r; else 0. Friction along r is simulated where one is not"),
};

constexpr auto effect_keys = [] {
  std::array<KeySpec, effect_table.size()> keys{};
  std::ranges::transform(effect_table, keys.begin(), [](const EffectRow& row) {
    return KeySpec{row.name, text, "", "\"auto\"", 0, 0, false, row.meaning};
  });
  return keys;
}();

constexpr std::array accuracy_keys{
    KeySpec{"tolerance", other, "1", "\"off\"", 0, 0.5, true,
            "of every peak, e.g. \"2 %\": settings are refined until they are that exact; off: as "
            "written"},
    KeySpec{"goals", other, "", "[\"peak_amplitude\", \"peak_frequency\"]", 0, 0, false,
            "what the tolerance is kept for; \"dissipated_energy\" as well; \"optimum\": that of a "
            "best value is told"},
    KeySpec{"budget", other, "s", "\"off\"", 0, unbounded, true,
            "wall time of a run, e.g. \"60 s\"; then it ends with the best it has"},
    KeySpec{"error_budget", text, "", "\"auto\"", 0, 0, false,
            "what mesh, basis, cells, fit, harmonics … do to every peak: auto or off"},
    KeySpec{"extrapolation", text, "", "\"auto\"", 0, 0, false,
            "where a tolerance is asked for and the geometry is meshed here: modes extrapolated to "
            "elements of no size from meshes twice and four times as coarse: auto or off"},
};

constexpr std::array<KeySpec, 0> named_by_the_user{};

constexpr std::array<SectionSpec, 49> sections{{
    {"model.blade", blade_keys},
    {"model.step", step_keys},
    {"faces", named_by_the_user},
    {"face", face_keys},
    {"model.mesh", mesh_keys},
    {"model.modes", modes_model_keys},
    {"material.modes", given_material_keys},
    {"modes.modes", given_mode_keys},
    {"model.modal", modal_model_keys},
    {"material", material_keys},
    {"supports", support_keys},
    {"static", static_keys},
    {"static.modes", given_static_keys},
    {"static.axis", axis_keys},
    {"static.force", static_force_keys},
    {"static.pressure", pressure_keys},
    {"modes", mode_keys},
    {"points", named_by_the_user},
    {"contact", contact_keys},
    {"contact.modal", modal_contact_keys},
    {"excitation", excitation_keys},
    {"force", force_keys},
    {"gap", gap_keys},
    {"output", output_keys},
    {"response", response_keys},
    {"response.modal", modal_response_keys},
    {"modal", modal_keys},
    {"modal.point", modal_point_keys},
    {"effects", effect_keys},
    {"accuracy", accuracy_keys},
    {"model.bar", bar_model_keys},
    {"modes.bar", bar_mode_keys},
    {"contact.bar", bar_contact_keys},
    {"excitation.bar", bar_excitation_keys},
    {"response.bar", modal_response_keys},
    {"model.chain", chain_model_keys},
    {"modes.chain", chain_mode_keys},
    {"contact.chain", chain_contact_keys},
    {"contact.chain.point", chain_contact_point_keys},
    {"response.chain", chain_response_keys},
    {"force.chain", chain_force_keys},
    {"excitation.chain", excitation_keys},
    {"model.block", block_model_keys},
    {"modes.block", chain_mode_keys},
    {"contact.block", block_contact_keys},
    {"excitation.block", block_excitation_keys},
    {"force.block", block_force_keys},
    {"output.block", block_output_keys},
    {"response.block", block_response_keys},
}};

constexpr std::array<std::string_view, 11> mesh_sections{
    "model",   "material",   "supports", "static",  "modes",   "points",
    "contact", "excitation", "response", "effects", "accuracy"};
constexpr std::array<std::string_view, 12> step_sections{
    "model",  "faces",   "material",   "supports", "static",  "modes",
    "points", "contact", "excitation", "response", "effects", "accuracy"};
constexpr std::array<std::string_view, 6> modal_sections{"model",    "modal",   "contact",
                                                         "response", "effects", "accuracy"};
constexpr std::array<std::string_view, 10> given_modes_sections{
    "model",   "material",   "static",   "modes",   "points",
    "contact", "excitation", "response", "effects", "accuracy"};
constexpr std::array<std::string_view, 7> lean_sections{
    // bar, chain, block
    "model", "modes", "contact", "excitation", "response", "effects", "accuracy"};

}  // namespace

SectionSpec section_spec(std::string_view name) {
  for (const SectionSpec& section : sections) {
    if (section.name == name) return section;
  }
  throw std::logic_error("no scene section " + std::string(name));
}

SectionSpec section_spec(std::string_view section, std::string_view kind) {
  const std::string own = fmt::format("{}.{}", section, kind);
  const bool has_own = std::any_of(sections.begin(), sections.end(),
                                   [&](const SectionSpec& spec) { return spec.name == own; });
  return section_spec(has_own ? std::string_view(own) : section);
}

KeySpec point_key(std::string_view name) {
  return {name,       other,
          "m",        "",
          -unbounded, unbounded,
          false,      "coordinates [x, y, z]: the nearest node; or a name of the mesh"};
}

KeySpec face_key(std::string_view name) {
  return {name, other, "",    "",
          0,    0,     false, "a face by a point, its normal or its number; or a list"};
}

std::span<const std::string_view> sections_of_kind(std::string_view kind) {
  if (kind == "step") return step_sections;
  if (kind == "modes") return given_modes_sections;
  if (kind == "modal") return modal_sections;
  if (kind == "bar" || kind == "chain" || kind == "block") return lean_sections;
  return mesh_sections;
}

std::string range_text(const KeySpec& key) {
  const bool from = key.low > -unbounded;
  const bool to = key.high < unbounded;
  if (from && to && key.low == key.high) return fmt::format("{:g}", key.low);
  if (from && to) {
    return key.above_low ? fmt::format("above {:g}, at most {:g}", key.low, key.high)
                         : fmt::format("{:g} to {:g}", key.low, key.high);
  }
  if (from) return fmt::format("{} {:g}", key.above_low ? "above" : "at least", key.low);
  if (to) return fmt::format("at most {:g}", key.high);
  return "any number";
}

}  // namespace microslip::pipelines
