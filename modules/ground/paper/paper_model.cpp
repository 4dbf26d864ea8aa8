#include "modules/ground/paper/paper_model.hpp"

namespace plumb {

PaperModel default_paper_model() {
  PaperModel model;
  model.dense_n1 = {1.44e-5, 1.84e-3, 2e-5, 4e-4, 1e-4};
  model.dense_n3 = {4.8e-5, 1.5e-3, 2e-5, 4e-4, 1e-4};
  model.dense_h = {2.1e-3, 1.95e-2, 1e-3, 4e-2, 1e-2};
  model.points_h = {1.275e-2, -1.98e-5, 4e-3, 4e-2, 2e-2};
  model.objects_n3 = {0.0, 1.0, 1e-6, 1e-2, 9.2e-5};
  return model;
}

}  // namespace plumb
