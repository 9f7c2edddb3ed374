// Where a runtime comes from.
#ifndef LWUCM_RUNTIME_HPP
#define LWUCM_RUNTIME_HPP

#include <memory>

#include "lwucm/container.hpp"
#include "lwucm/errors.hpp"
#include "lwucm/repository.hpp"

namespace lwucm {

/// A new, empty, independent runtime that can instantiate what `repository` holds now.
std::shared_ptr<ContainerManager> create_runtime(const Repository& repository);

}  // namespace lwucm

#endif
