"""The Python reference framework's adapter: each operation forwarded one to one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from ucm_cts.adapters.contract.programming_model import Implementation
from ucm_cts.adapters.reference.python.framework import ContainerManager
from ucm_cts.adapters.sdk.python.forwarding import ForwardingAdapter


class ReferenceAdapter(ForwardingAdapter):
    """Binds the Python reference framework. Subclasses bind variants of it by naming another ``manager_class``."""

    product = "UCM-CTS reference framework (Python)"
    version = "1"
    manager_class: ClassVar[type[ContainerManager]] = ContainerManager

    def create_runtime(self, implementations: Sequence[Implementation]) -> ContainerManager:
        return self.manager_class(implementations)
