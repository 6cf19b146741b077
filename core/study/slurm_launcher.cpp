// SPDX-License-Identifier: Apache-2.0
#include "study/launcher.hpp"

#include "base/error.hpp"

namespace dust::study {

std::unique_ptr<Launcher> make_slurm_launcher(const PointStore&, const Resources&, const SlurmSpec&,
                                              const std::string&) {
  throw base::UserError("error: --launcher slurm: not in this build");
}

}  // namespace dust::study
