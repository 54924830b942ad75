#include "materials.h"

namespace plumbline::renderer {

const std::map<std::string, double> kRefractiveIndices = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
};

const std::map<std::string, ConductorFresnel> kMetals = {
    {"none", {}},
    {"Ag", {{0.155265f, 0.116723f, 0.138381f}, {4.82834f, 3.12225f, 2.14695f}}},
    {"Al", {{1.65746f, 0.880369f, 0.521229f}, {9.22387f, 6.26952f, 4.83700f}}},
    {"Au", {{0.143119f, 0.374957f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}}},
    {"Cr", {{4.36968f, 2.91670f, 1.65470f}, {5.20643f, 4.23136f, 3.75495f}}},
    {"Cu", {{0.200438f, 0.924033f, 1.10221f}, {3.91295f, 2.45285f, 2.14219f}}},
};

}  // namespace plumbline::renderer
