// Names of ports and properties: quoted in errors, and found in lists.
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
