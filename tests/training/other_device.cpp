#include "tests/training/other_device.h"

#include <ATen/ATen.h>
#include <ATen/EmptyTensor.h>
#include <ATen/core/dispatch/Dispatcher.h>
#include <ATen/ops/_reshape_alias_native.h>
#include <ATen/ops/as_strided_native.h>
#include <ATen/ops/view_native.h>
#include <c10/core/impl/DeviceGuardImplInterface.h>
#include <torch/library.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

namespace fracbench::test {

namespace {

using at::IntArrayRef;
using at::Tensor;
using MaybeTensor = c10::optional<Tensor>;

const c10::Device kDevice(c10::DeviceType::PrivateUse1, 0);

bool is_here(const Tensor& tensor) {
  return tensor.defined() && tensor.device().type() == kDevice.type();
}

/// The same memory, which stays as long as the result. The processor may take another for it.
Tensor seen_from(const c10::Device& device, const Tensor& tensor) {
  if (!tensor.defined()) return tensor;
  const c10::DispatchKey key =
      device.is_cpu() ? c10::DispatchKey::CPU : c10::DispatchKey::PrivateUse1;
  Tensor seen = at::detail::make_tensor<c10::TensorImpl>(
      c10::make_intrusive<c10::StorageImpl>(
          c10::StorageImpl::use_byte_size_t(),
          at::detail::computeStorageNbytes(tensor.sizes(), tensor.strides(), tensor.itemsize()),
          c10::InefficientStdFunctionContext::makeDataPtr(
              tensor.data_ptr(), [tensor](void*) {}, device),
          c10::GetAllocator(c10::kCPU), /*resizable=*/true),
      c10::DispatchKeySet(key), tensor.dtype());
  seen.unsafeGetTensorImpl()->set_sizes_and_strides(tensor.sizes(), tensor.strides());
  return seen;
}

Tensor ours(const Tensor& of_processor) { return seen_from(kDevice, of_processor); }

/// What the processor has made of `own`, which may have got another shape and other memory.
void take_over(const Tensor& own, const Tensor& of_processor) {
  const Tensor changed = ours(of_processor);
  c10::TensorImpl* const it = own.unsafeGetTensorImpl();
  if (own.data_ptr() != changed.data_ptr()) {
    it->set_storage_keep_dtype(changed.storage());
    it->set_storage_offset(0);
  }
  it->set_sizes_and_strides(changed.sizes(), changed.strides());
}

/// For an operation on this device.
Tensor for_processor(const Tensor& tensor) {
  if (!tensor.defined()) return tensor;
  if (is_here(tensor)) return seen_from(c10::kCPU, tensor);
  TORCH_CHECK(tensor.dim() == 0, "tensors of ", kDevice, " and of ", tensor.device(),
              " in one operation");
  return tensor;
}
MaybeTensor for_processor(const MaybeTensor& tensor) {
  return tensor ? MaybeTensor(for_processor(*tensor)) : tensor;
}

/// Whatever operation has no other way here.
void on_processor(const c10::OperatorHandle& operation, torch::jit::Stack* stack) {
  std::vector<std::pair<Tensor, Tensor>> seen;  // by the processor, ours
  const auto take = [&](const Tensor& tensor) {
    return seen.emplace_back(for_processor(tensor), tensor).first;
  };
  const std::size_t count = operation.schema().arguments().size(), first = stack->size() - count;
  for (std::size_t k = first; k < stack->size(); ++k) {
    c10::IValue& value = (*stack)[k];
    if (value.isTensor()) {
      value = take(value.toTensor());
    } else if (value.isTensorList()) {
      c10::List<Tensor> list;
      for (const Tensor& tensor : value.toTensorVector()) list.push_back(take(tensor));
      value = list;
    } else if (value.isDevice()) {
      value = c10::Device(c10::kCPU);
    }
  }
  operation.redispatchBoxed(c10::DispatchKeySet(c10::DispatchKey::CPU), stack);
  const std::size_t results = operation.schema().returns().size();
  for (std::size_t k = stack->size() - results; k < stack->size(); ++k) {
    c10::IValue& value = (*stack)[k];
    if (!value.isTensor() || !value.toTensor().defined()) continue;
    const Tensor result = value.toTensor();
    const auto is_result = [&](const auto& pair) { return pair.first.is_same(result); };
    const auto known = std::ranges::find_if(seen, is_result);
    if (known == seen.end()) {
      value = ours(result);
    } else {
      take_over(known->second, result);
      value = known->second;
    }
  }
}

Tensor empty(IntArrayRef size, c10::optional<at::ScalarType> type, c10::optional<at::Layout>,
             c10::optional<at::Device>, c10::optional<bool>,
             c10::optional<at::MemoryFormat> format) {
  return ours(at::empty(size, at::TensorOptions().dtype(type), format));
}

Tensor empty_strided(IntArrayRef size, IntArrayRef stride, c10::optional<at::ScalarType> type,
                     c10::optional<at::Layout>, c10::optional<at::Device>, c10::optional<bool>) {
  return ours(at::empty_strided(size, stride, at::TensorOptions().dtype(type)));
}

/// The one operation that takes tensors of both, either way.
Tensor copy_from(const Tensor& from, const Tensor& to, bool) {
  const auto plain = [](const Tensor& tensor) {
    return is_here(tensor) ? seen_from(c10::kCPU, tensor) : tensor;
  };
  plain(to).copy_(plain(from));
  return to;
}

/// By the common way, libtorch would warn of a result that gets the shape of what it is the mean
/// of.
Tensor mse_loss(const Tensor& values, const Tensor& wanted, std::int64_t reduction) {
  return ours(at::mse_loss(for_processor(values), for_processor(wanted), reduction));
}

Tensor convolution(const Tensor& input, const Tensor& weight, const MaybeTensor& bias,
                   IntArrayRef stride, IntArrayRef padding, IntArrayRef dilation, bool transposed,
                   IntArrayRef output_padding, std::int64_t groups) {
  return ours(at::convolution(for_processor(input), for_processor(weight), for_processor(bias),
                              stride, padding, dilation, transposed, output_padding, groups));
}

std::tuple<Tensor, Tensor, Tensor> convolution_backward(const Tensor& gradient, const Tensor& input,
                                                        const Tensor& weight, IntArrayRef stride,
                                                        IntArrayRef padding, IntArrayRef dilation,
                                                        bool transposed, IntArrayRef output_padding,
                                                        std::int64_t groups,
                                                        std::array<bool, 3> wanted) {
  const std::array<std::int64_t, 1> biases{transposed ? weight.size(1) * groups : weight.size(0)};
  const auto [of_input, of_weight, of_bias] = at::convolution_backward(
      for_processor(gradient), for_processor(input), for_processor(weight), IntArrayRef(biases),
      stride, padding, dilation, transposed, output_padding, groups, wanted);
  return {ours(of_input), ours(of_weight), ours(of_bias)};
}

/// One device with one stream.
class Guard final : public c10::impl::DeviceGuardImplInterface {
 public:
  c10::DeviceType type() const override { return kDevice.type(); }
  c10::Device exchangeDevice(c10::Device) const override { return kDevice; }
  c10::Device getDevice() const override { return kDevice; }
  void setDevice(c10::Device) const override {}
  void uncheckedSetDevice(c10::Device) const noexcept override {}
  c10::Stream getStream(c10::Device) const noexcept override { return stream(); }
  c10::Stream getDefaultStream(c10::Device) const override { return stream(); }
  c10::Stream exchangeStream(c10::Stream) const noexcept override { return stream(); }
  c10::DeviceIndex deviceCount() const noexcept override { return 1; }

 private:
  static c10::Stream stream() { return c10::Stream(c10::Stream::DEFAULT, kDevice); }
};

C10_REGISTER_GUARD_IMPL(PrivateUse1, Guard);

TORCH_LIBRARY_IMPL(aten, PrivateUse1, library) {
  library.impl("empty.memory_format", &empty);
  library.impl("empty_strided", &empty_strided);
  library.impl("_copy_from", &copy_from);
  library.impl("as_strided", &at::native::as_strided_tensorimpl);
  library.impl("view", &at::native::view);
  library.impl("_reshape_alias", &at::native::_reshape_alias);
  library.impl("mse_loss", &mse_loss);
  library.impl("convolution_overrideable", &convolution);
  library.impl("convolution_backward_overrideable", &convolution_backward);
}

TORCH_LIBRARY_IMPL(_, PrivateUse1, library) {
  library.fallback(torch::CppFunction::makeFromBoxedFunction<&on_processor>());
}

}  // namespace

}  // namespace fracbench::test
