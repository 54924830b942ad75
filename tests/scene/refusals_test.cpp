#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "refusal.h"
#include "scene_text.h"

/// Every way in which a file leaves the supported subset is refused with its line and its reason.
namespace plumbline::tests {
namespace {

class RefusedBody : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedBody, SaysWhereAndWhy) {
  EXPECT_EQ(refusal_of_text(scene_with(GetParam().text)),
            std::string("scene.xml:") + GetParam().expected);
}

const std::vector<Refusal> kBodies = {
    // Elements and types outside the subset.
    {"UnknownElement", "<shap type=\"sphere\"/>",
     R"(3: <scene> may not hold <shap>; did you mean "shape"?)"},
    {"UnsupportedElement", "<medium type=\"homogeneous\"/>",
     "3: <scene> may not hold <medium>: remove it"},
    {"Include", "<include filename=\"other.xml\"/>",
     "3: <include>: other.xml: there is no such file"},
    {"UnknownShape", "\n<shape type=\"sphear\"/>",
     R"(4: <shape> of type "sphear" is not supported; did you mean "sphere"?)"},
    {"UnknownShapeInStrangeCharacters", "<shape type=\"\x7f~ \x1f\xc3\xa9\"/>",
     "3: <shape> of type \"?~ ?\xc3\xa9\" is not supported; supported: sphere, rectangle, disk, "
     "obj"},
    {"UnsupportedShape", "<shape type=\"cylinder\"/>",
     R"(3: <shape> of type "cylinder" is not supported: convert the mesh to an obj file)"},
    {"NoType", "<shape/>", R"(3: <shape> needs the attribute "type")"},
    {"UnsupportedBsdf", "<bsdf type=\"measured\" id=\"a\"/>",
     "3: <bsdf> of type \"measured\" is not supported: write diffuse, roughconductor, "
     "roughdielectric, or a blendbsdf of two of them"},
    {"UnsupportedIntegrator", "<integrator type=\"volpath\"/>",
     R"(3: <integrator> of type "volpath" is not supported: write path)"},
    {"EnvironmentInShape", "<shape type=\"sphere\"><emitter type=\"constant\"/></shape>",
     R"(3: <emitter> of type "constant" is not supported; supported: area)"},
    {"AreaLightWithoutShape", "<emitter type=\"area\"/>",
     R"(3: <emitter> of type "area" is not supported; supported: constant, envmap, point, sun)"},
    {"UnsupportedEmitter", "<emitter type=\"spot\"/>",
     R"(3: <emitter> of type "spot" is not supported; supported: constant, envmap, point, sun)"},
    {"PointWithoutIntensity", "<emitter type=\"point\"/>",
     R"(3: <emitter type="point"> needs <rgb name="intensity">)"},
    {"SunWithoutDirection", "<emitter type=\"sun\"><rgb name=\"radiance\" value=\"1\"/></emitter>",
     R"(3: <emitter type="sun"> needs <vector name="direction">)"},
    {"SunFromNowhere",
     "<emitter type=\"sun\"><vector name=\"direction\" value=\"0\"/>"
     "<rgb name=\"radiance\" value=\"1\"/></emitter>",
     R"(3: <vector name="direction">: must have a length that is neither zero nor infinite)"},
    {"SunLargerThanTheSky",
     "<emitter type=\"sun\"><vector name=\"direction\" z=\"-1\"/><float name=\"half_angle\" "
     "value=\"91\"/><rgb name=\"radiance\" value=\"1\"/></emitter>",
     R"(3: <float name="half_angle">: must lie between 0.001 and 90 degrees)"},
    {"TransformWithNumbersOfItsOwn",
     "<shape type=\"disk\"><transform name=\"to_world\" x=\"1\"/></shape>",
     R"(3: <transform name="to_world"> has no attribute "x"; supported: name)"},
    {"UnknownTransform",
     "<shape type=\"disk\"><transform name=\"to_world\">\n<lookAt/></transform></shape>",
     R"(4: <lookAt> is not a transform operation; did you mean "lookat"?)"},
    {"ElementInsideAProperty",
     "<shape type=\"sphere\"><float name=\"radius\" value=\"1\"><x/></float></shape>",
     R"(3: <float name="radius"> may hold nothing)"},

    // Properties and attributes.
    {"MisspeltProperty", "<shape type=\"sphere\">\n<float name=\"radus\" value=\"1\"/></shape>",
     R"(4: <shape type="sphere"> has no property "radus"; did you mean "radius"?)"},
    {"CamelCaseProperty", "<shape type=\"disk\"><transform name=\"toWorld\"/></shape>",
     R"(3: <shape type="disk"> has no property "toWorld"; did you mean "to_world"?)"},
    {"PropertyOfAnotherShape",
     "<shape type=\"rectangle\"><float name=\"radius\" value=\"1\"/></shape>",
     "3: <shape type=\"rectangle\"> has no property \"radius\"; supported: flip_normals, to_world"},
    {"WrongTypeOfProperty", "<shape type=\"sphere\"><string name=\"radius\" value=\"1\"/></shape>",
     R"(3: <string name="radius"> of <shape type="sphere"> must be a <float>)"},
    {"Texture",
     "<bsdf type=\"diffuse\" id=\"a\"><texture name=\"reflectance\" type=\"bitmap\"/></bsdf>",
     "3: <texture name=\"reflectance\"> of <bsdf type=\"diffuse\"> must be a <rgb> or <spectrum>: "
     "write <rgb> with the texture's mean colour"},
    {"PropertyTwice",
     "<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/>\n<float name=\"radius\" "
     "value=\"2\"/></shape>",
     R"(4: <shape type="sphere"> has a second property "radius")"},
    {"PropertyWithoutName", "<shape type=\"sphere\"><float value=\"1\"/></shape>",
     R"(3: <float> needs the attribute "name")"},
    {"PropertyWithoutValue", "<shape type=\"sphere\"><float name=\"radius\"/></shape>",
     R"(3: <float name="radius"> needs the attribute "value")"},
    {"UnknownAttribute", "<shape type=\"sphere\" colour=\"red\"/>",
     R"(3: <shape type="sphere"> has no attribute "colour"; supported: type, id, name)"},
    {"MisspeltAttribute", "<shape type=\"sphere\"><float name=\"radius\" valeu=\"1\"/></shape>",
     R"(3: <float name="radius"> has no attribute "valeu"; did you mean "value"?)"},
    {"AttributeTwice", "<shape type=\"sphere\" type=\"disk\"/>",
     R"(3: attribute "type" is given twice)"},
    {"NestedObjectOfUnknownKind", "<shape type=\"sphere\"><interior type=\"x\"/></shape>",
     "3: <shape type=\"sphere\"> may not hold <interior>; supported: bsdf, ref, emitter, point, "
     "float, boolean, transform"},
    {"TwoBsdfs",
     "<shape type=\"sphere\"><bsdf type=\"diffuse\"/>\n<bsdf type=\"diffuse\"/></shape>",
     R"(4: <shape type="sphere"> may hold one <bsdf> or <ref> only)"},
    {"BsdfAndReference",
     "<shape type=\"sphere\"><bsdf type=\"diffuse\" id=\"a\"/>\n<ref id=\"a\"/></shape>",
     R"(4: <shape type="sphere"> may hold one <bsdf> or <ref> only)"},
    {"TwoEmitters",
     "<shape type=\"sphere\"><emitter type=\"area\"/><emitter type=\"area\"/></shape>",
     R"(3: <shape type="sphere"> may hold one <emitter> only)"},
    {"EmitterWithoutRadiance", "<shape type=\"sphere\"><emitter type=\"area\"/></shape>",
     R"(3: <emitter type="area"> needs <rgb name="radiance">)"},

    // Numbers.
    {"NotANumber", "<shape type=\"sphere\"><float name=\"radius\" value=\"one\"/></shape>",
     R"(3: <float name="radius">: "one" is not a number)"},
    {"TrailingGarbage", "<shape type=\"sphere\"><float name=\"radius\" value=\"1.5m\"/></shape>",
     R"(3: <float name="radius">: "1.5m" is not a number)"},
    {"EmptyNumber", "<shape type=\"sphere\"><float name=\"radius\" value=\"\"/></shape>",
     R"(3: <float name="radius">: "" is not a number)"},
    {"Hexadecimal", "<shape type=\"sphere\"><float name=\"radius\" value=\"0x10\"/></shape>",
     R"(3: <float name="radius">: "0x10" is not a number)"},
    {"TooLargeForADouble",
     "<shape type=\"sphere\"><float name=\"radius\" value=\"1e999\"/></shape>",
     R"(3: <float name="radius">: "1e999" is out of range)"},
    {"NaN", "<shape type=\"sphere\"><float name=\"radius\" value=\"nan\"/></shape>",
     R"(3: <float name="radius">: "nan" is not finite)"},
    {"Infinity", "<shape type=\"sphere\"><point name=\"center\" x=\"-inf\"/></shape>",
     R"(3: <point name="center">: "-inf" is not finite)"},
    {"FractionForAnInteger",
     "<integrator type=\"path\"><integer name=\"max_depth\" value=\"2.5\"/></integrator>",
     R"(3: <integer name="max_depth">: "2.5" is not a whole number)"},
    {"IntegerTooLarge",
     "<integrator type=\"path\"><integer name=\"max_depth\" value=\"3000000000\"/></integrator>",
     R"(3: <integer name="max_depth">: "3000000000" is out of range)"},
    {"NotABoolean", "<shape type=\"disk\"><boolean name=\"flip_normals\" value=\"1\"/></shape>",
     R"(3: <boolean name="flip_normals">: "1" is neither "true" nor "false")"},
    {"TwoNumbersForAColour",
     "<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"1, 1\"/></bsdf>",
     R"(3: <rgb name="reflectance"> needs one or three numbers, not 2)"},
    {"EmptyEntryInAList",
     "<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"1,,1\"/></bsdf>",
     R"(3: <rgb name="reflectance">: "" is not a number)"},
    {"CommaAtTheEnd",
     "<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"1, 1, 1,\"/></bsdf>",
     R"(3: <rgb name="reflectance">: "" is not a number)"},
    {"HexColour",
     "<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"#ff0000\"/></bsdf>",
     "3: <rgb name=\"reflectance\">: \"#ff0000\" is not a number: write linear ones, each (c / "
     "255)^2.2 or so of the sRGB byte c"},
    {"PointInBothForms",
     "<shape type=\"sphere\"><point name=\"center\" x=\"1\" value=\"1\"/></shape>",
     R"(3: <point name="center"> needs either "value" or any of "x", "y" and "z")"},

    // Values out of range.
    {"NegativeRadius", "<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>",
     R"(3: <float name="radius">: must be positive)"},
    {"ZeroRadius", "<shape type=\"sphere\"><float name=\"radius\" value=\"0\"/></shape>",
     R"(3: <float name="radius">: must be positive)"},
    {"HugeRadius", "<shape type=\"sphere\"><float name=\"radius\" value=\"1e30\"/></shape>",
     R"(3: <float name="radius">: makes a length of 1e+30: lengths go from 1e-18 to 1e+18)"},
    {"FarAway", "<shape type=\"sphere\"><point name=\"center\" x=\"1e30\"/></shape>",
     R"(3: <point name="center">: puts a coordinate beyond 1e+18)"},
    {"ReflectanceAboveOne",
     "<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"1, 1.1, 1\"/></bsdf>",
     R"(3: <rgb name="reflectance">: must lie between 0 and 1: more would create energy)"},
    {"NegativeReflectance",
     "<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"-0.1\"/></bsdf>",
     R"(3: <rgb name="reflectance">: must lie between 0 and 1: more would create energy)"},
    {"NegativeRadiance",
     "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"-1\"/></emitter>",
     R"(3: <rgb name="radiance">: must lie between 0 and 1e+15)"},
    {"MaxDepthBelowMinusOne",
     "<integrator type=\"path\"><integer name=\"max_depth\" value=\"-2\"/></integrator>",
     R"(3: <integer name="max_depth">: must be at least -1, which is unlimited)"},
    {"RussianRouletteFromTheStart",
     "<integrator type=\"path\"><integer name=\"rr_depth\" value=\"0\"/></integrator>",
     R"(3: <integer name="rr_depth">: must be at least 1)"},
    {"DepthOfTheDirectIntegrator",
     "<integrator type=\"direct\"><integer name=\"max_depth\" value=\"3\"/></integrator>",
     R"(3: <integrator type="direct"> may not hold <integer>)"},

    // Transforms.
    {"SphereScaledUnevenly",
     "<shape type=\"sphere\"><transform name=\"to_world\"><scale x=\"2\"/></transform></shape>",
     "3: <transform name=\"to_world\">: would make an ellipsoid: scale a sphere alike along all "
     "axes"},
    {"DiskScaledUnevenly",
     "<shape type=\"disk\"><transform name=\"to_world\"><scale x=\"2\"/></transform></shape>",
     "3: <transform name=\"to_world\">: would make an ellipse: scale a disk alike along x and y"},
    {"RectangleSheared",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><matrix value=\"1 1 0 0 1 0 0 0 "
     "1\"/></transform></shape>",
     "3: <transform name=\"to_world\">: shears the rectangle: its edges must stay perpendicular"},
    {"ScaleOfZero",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><scale z=\"0\"/></transform></shape>",
     R"(3: <transform name="to_world"> is singular: it flattens space)"},
    {"SingularMatrix",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><matrix value=\"1 2 3 4 5 6 7 8 "
     "9\"/></transform></shape>",
     R"(3: <transform name="to_world"> is singular: it flattens space)"},
    {"Projection",
     "<shape type=\"disk\"><transform name=\"to_world\"><matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 "
     "0 "
     "1 1\"/></transform></shape>",
     "3: <matrix> must have the last row 0 0 0 1: projections are not supported"},
    {"MatrixOfTenNumbers",
     "<shape type=\"disk\"><transform name=\"to_world\"><matrix value=\"1 0 0 0 0 1 0 0 0 "
     "0\"/></transform></shape>",
     "3: <matrix> needs 9 or 16 numbers, not 10"},
    {"TransformOverflows",
     "<shape type=\"disk\"><transform name=\"to_world\"><scale value=\"1e200\"/><scale "
     "value=\"1e200\"/></transform></shape>",
     R"(3: <transform name="to_world"> overflows)"},
    {"RotationWithoutAxis",
     "<shape type=\"disk\"><transform name=\"to_world\"><rotate x=\"0\" angle=\"3\"/></transform>"
     "</shape>",
     "3: <rotate>: the axis has no direction"},
    {"RotationWithoutAngle",
     "<shape type=\"disk\"><transform name=\"to_world\"><rotate x=\"1\"/></transform></shape>",
     R"(3: <rotate> needs the attribute "angle")"},
    {"TranslationToNowhere",
     "<shape type=\"disk\"><transform name=\"to_world\"><translate/></transform></shape>",
     R"(3: <translate> needs either "value" or any of "x", "y" and "z")"},
    {"LookatOntoItself",
     "<shape type=\"disk\"><transform name=\"to_world\"><lookat origin=\"1 1 1\" target=\"1 1 1\" "
     "up=\"0 1 0\"/></transform></shape>",
     R"(3: <lookat>: "target" and "origin" are the same point)"},
    {"LookatAlongUp",
     "<shape type=\"disk\"><transform name=\"to_world\"><lookat origin=\"0 0 0\" target=\"0 5 0\" "
     "up=\"0 1 0\"/></transform></shape>",
     R"(3: <lookat>: "up" points along the line of sight)"},
    {"LookatWithoutUp",
     "<shape type=\"disk\"><transform name=\"to_world\"><lookat origin=\"0 0 0\" target=\"0 5 "
     "0\"/></transform></shape>",
     R"(3: <lookat> needs the attribute "up")"},

    // Ids, references, parameters.
    {"IdTwice", "<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>",
     R"(4: id "a" is taken by the <bsdf> on line 3)"},
    {"EmptyId", "<bsdf type=\"diffuse\" id=\"\"/>", R"(3: <bsdf type="diffuse"> has an empty id)"},
    {"UnknownReference",
     "<bsdf type=\"diffuse\" id=\"white\"/><shape type=\"disk\">\n<ref id=\"whit\"/></shape>",
     R"(4: no <bsdf> has the id "whit"; did you mean "white"?)"},
    {"ReferenceWithoutAnyBsdf", "<shape type=\"disk\"><ref id=\"white\"/></shape>",
     R"(3: no <bsdf> has the id "white")"},
    {"ReferenceToAShape", "<shape type=\"disk\" id=\"a\"><ref id=\"a\"/></shape>",
     R"(3: id "a" is a <shape>, not a <bsdf>)"},
    {"ReferenceInTheScene", "<ref id=\"a\"/>",
     "3: <scene> may not hold <ref>; supported: default, include, integrator, path, sensor, bsdf, "
     "shape, emitter"},
    {"SharedBsdfWithoutId", "<bsdf type=\"diffuse\"/>",
     R"(3: <bsdf type="diffuse"> needs an id, or no shape can refer to it)"},
    {"UndeclaredParameter",
     "<default name=\"radius\" value=\"1\"/><shape type=\"sphere\">\n<float name=\"radius\" "
     "value=\"$radus\"/></shape>",
     R"(4: <float name="radius">: no <default> before this line declares $radus; did you mean "radius"?)"},
    {"ParameterBeforeItsDefault",
     "<shape type=\"sphere\"><float name=\"radius\" value=\"$r\"/></shape><default name=\"r\" "
     "value=\"1\"/>",
     R"(3: <float name="radius">: no <default> before this line declares $r)"},
    {"LoneDollar", "<shape type=\"sphere\"><float name=\"radius\" value=\"$\"/></shape>",
     R"(3: <float name="radius">: a $ must be followed by a parameter's name)"},
    {"ParameterTwice", "<default name=\"a\" value=\"1\"/>\n<default name=\"a\" value=\"2\"/>",
     R"(4: parameter "a" is declared twice)"},
    {"ParameterWithoutAName", "<default name=\"2a\" value=\"1\"/>",
     R"(3: "2a" is no name for a parameter: letters, digits and _, not starting with a digit)"},

    // What a scene holds once.
    {"TwoSensors", "<sensor type=\"perspective\"/>", "3: a scene has one <sensor> only"},
    {"TwoIntegrators", "<integrator type=\"path\"/>\n<integrator type=\"direct\"/>",
     "4: a scene has one <integrator> only"},
    {"TwoEnvironments",
     "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>\n"
     "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"2\"/></emitter>",
     "4: a scene has one constant <emitter> only"},
    {"NothingToSee", "", "1: the scene has neither a <shape> nor an <emitter>"},
    {"TextBetweenElements", "<shape type=\"sphere\"/>\nhello",
     "3: text \"?hello?\" outside of an attribute"},

    // Meshes.
    {"ObjWithoutFile", "<shape type=\"obj\"/>",
     R"(3: <shape type="obj"> needs <string name="filename">)"},
    {"ObjWithSmoothNormals",
     "<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/></shape>",
     "3: <shape type=\"obj\">: false, the default, asks for smooth normals, which are not "
     "supported: write <boolean name=\"face_normals\" value=\"true\"/> for flat triangles"},
    {"MissingMesh",
     "<shape type=\"obj\"><string name=\"filename\" value=\"no.obj\"/><boolean "
     "name=\"face_normals\" value=\"true\"/></shape>",
     R"(3: <string name="filename">: no.obj: there is no such file)"},
};

INSTANTIATE_TEST_SUITE_P(SceneFile, RefusedBody, testing::ValuesIn(kBodies), name_of);

class RefusedFile : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedFile, SaysWhereAndWhy) {
  EXPECT_EQ(refusal_of_text(GetParam().text), std::string("scene.xml:") + GetParam().expected);
}

const std::vector<Refusal> kFiles = {
    {"Empty", "", " is empty"},
    {"WhiteSpace", " \n \n", "1: holds no XML element; a <scene> was expected"},
    {"NotXml", "once upon a time", R"(1: text "once upon a time" outside of an attribute)"},
    {"UnclosedElement", "<scene version=\"3.0.0\">\n<shape type=\"sphere\">\n</scene>",
     "3: is not well-formed XML: Start-end tags mismatch"},
    {"CutShort", "<scene version=\"3.0.0\">\n<shape typ",
     "2: is not well-formed XML: Error parsing element attribute"},
    {"AnotherRoot", "<?xml version=\"1.0\"?>\n<html/>",
     "2: the outermost element is <html>, not <scene>"},
    {"TwoRoots", "<scene version=\"3.0.0\"/>\n<scene version=\"3.0.0\"/>",
     "2: a file holds one <scene> only"},
    {"NoVersion", "<scene/>", R"(1: <scene> needs the attribute "version")"},
    {"AttributeOfTheScene", "<scene version=\"3.0.0\" verson=\"3.0.0\"/>",
     R"(1: <scene> has no attribute "verson"; did you mean "version"?)"},
    {"OldVersion", "<scene version=\"0.6.0\"/>",
     "1: scene version \"0.6.0\" is not supported: write 3.0.0, and names as it has them: to_world "
     "for toWorld, and so for all in camelCase (max_depth, sample_count, fov_axis, flip_normals, "
     "int_ior, ext_ior, alpha_u, near_clip), and lookat for lookAt"},
    {"NewVersion", "<scene version=\"4.0.0\"/>",
     R"(1: scene version "4.0.0" is not supported; write 3.0.0)"},
    {"NoSensor", "<scene version=\"3.0.0\">\n<shape type=\"sphere\"/></scene>",
     "1: the scene has no <sensor>"},
    {"ExternalEntity",
     "<?xml version=\"1.0\"?>\n<!DOCTYPE scene [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>\n"
     "<scene version=\"3.0.0\">&x;</scene>",
     "2: <!DOCTYPE> is refused: a scene file declares no entities and reads no other document"},
    {"EntityBomb",
     "<!DOCTYPE b [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;\"><!ENTITY c \"&b;&b;&b;&b;\">]>"
     "<scene version=\"3.0.0\">&c;</scene>",
     "1: <!DOCTYPE> is refused: a scene file declares no entities and reads no other document"},
    {"ProcessingInstruction", "<scene version=\"3.0.0\">\n<?xml-stylesheet href=\"a\"?></scene>",
     "2: processing instruction \"xml-stylesheet\" is not supported"},
    {"CharacterData", "<scene version=\"3.0.0\">\n<![CDATA[x]]></scene>",
     R"(2: text "x" outside of an attribute)"},
    {"SensorOfAnotherType", "<scene version=\"3.0.0\"><sensor type=\"thinlens\"/></scene>",
     R"(1: <sensor> of type "thinlens" is not supported: write perspective, a pinhole)"},
    {"SensorWithoutFieldOfView",
     "<scene version=\"3.0.0\">\n<sensor type=\"perspective\"/></scene>",
     R"(2: <sensor type="perspective"> needs <float name="fov">)"},
    {"MisspeltFieldOfView",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\">\n<float name=\"fvo\" "
     "value=\"40\"/></sensor></scene>",
     R"(2: <sensor type="perspective"> has no property "fvo"; did you mean "fov"?)"},
    {"NegativeClippingPlane",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\">\n<float name=\"near_clip\" "
     "value=\"-1\"/></sensor></scene>",
     R"(2: <float name="near_clip">: must be at least 0)"},
    {"SensorWithoutFilm",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/></sensor></scene>",
     R"(1: <sensor type="perspective"> needs <film>)"},
    {"FieldOfViewOf180",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"180\"/><film type=\"hdrfilm\"/></sensor></scene>",
     R"(1: <float name="fov">: must lie between 0 and 180 degrees, both excluded)"},
    {"UnknownFieldOfViewAxis",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/><string name=\"fov_axis\" value=\"z\"/><film type=\"hdrfilm\"/></sensor>"
     "</scene>",
     "1: <string name=\"fov_axis\">: \"z\" is not supported; supported: x, y, diagonal, smaller, "
     "larger"},
    {"ScaledCamera",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/><transform name=\"to_world\"><scale value=\"2\"/></transform><film "
     "type=\"hdrfilm\"/></sensor></scene>",
     "1: <transform name=\"to_world\">: a camera may be turned and moved, not scaled or sheared"},
    {"FilmWithoutFilter",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/>\n<film type=\"hdrfilm\"/></sensor></scene>",
     "2: <film type=\"hdrfilm\"> needs <rfilter>: write <rfilter type=\"box\"/>, Mitsuba's default "
     "is another"},
    {"GaussianFilter",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/><film type=\"hdrfilm\"><rfilter type=\"gaussian\"/></film></sensor></scene>",
     "1: <rfilter> of type \"gaussian\" is not supported: write box, by which pixels depend on "
     "their own samples alone"},
    {"FilmOfNoWidth",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/><film type=\"hdrfilm\"><integer name=\"width\" value=\"0\"/><rfilter "
     "type=\"box\"/></film></sensor></scene>",
     "1: <integer name=\"width\">: a film of 0x576 is not supported: sides go from 1 to 65536, "
     "pixels up to 67108864"},
    {"PixelsWithAlpha",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/><film type=\"hdrfilm\"><string name=\"pixel_format\" value=\"rgba\"/><rfilter "
     "type=\"box\"/></film></sensor></scene>",
     R"(1: <string name="pixel_format">: "rgba" is not supported; supported: rgb)"},
    {"NoSamples",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
     "value=\"40\"/><film type=\"hdrfilm\"><rfilter type=\"box\"/></film><sampler "
     "type=\"independent\"><integer name=\"sample_count\" value=\"0\"/></sampler></sensor></scene>",
     R"(1: <integer name="sample_count">: must be at least 1)"},
};

INSTANTIATE_TEST_SUITE_P(SceneFile, RefusedFile, testing::ValuesIn(kFiles), name_of);

}  // namespace
}  // namespace plumbline::tests
