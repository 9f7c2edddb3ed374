// Names of ports and properties: told of in errors, and looked for.
#ifndef LWUCM_SRC_NAMES_HPP
#define LWUCM_SRC_NAMES_HPP

#include <algorithm>
#include <string>
#include <vector>

namespace lwucm {

inline std::string quoted(const std::string& name) { return "'" + name + "'"; }

inline bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace lwucm

#endif
