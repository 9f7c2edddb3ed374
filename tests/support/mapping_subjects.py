"""Models of the suite with the IDL and C++ that is expected of them, and one small model with IDL by hand."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.toolchains.cpp.compiling import Headers
from ucm_cts.harness.toolchains.generation import OPEN
from ucm_cts.reference_models.mapping.cpp.expected import ExpectedCpp, Standard
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp
from ucm_cts.reference_models.mapping.idl.expectations import ExpectedIdl
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl


class Subject(NamedTuple):
    """A model, what clause 12 makes of it, and what the reference generates."""

    name: str
    model: Model
    expected: ExpectedIdl
    files: Mapping[str, str]


@functools.cache
def subjects() -> tuple[Subject, ...]:
    """All models that profile idl uses, but for those that may be refused."""
    folders = (SUITE / "models" / "mapping", SUITE / "models" / "legal")
    paths = [p for folder in folders for p in sorted(folder.glob("*.xml")) if not p.name.startswith(OPEN)]
    generate = reference().generators["idl"]
    found = []
    for path in paths:
        reading = read_model(path.read_bytes(), path.name)
        assert not reading.problems, path
        found.append(Subject(path.stem, reading.model, expected_idl(reading.model), generate(reading.model)))
    return tuple(found)


def model_of(xml: str) -> Model:
    """The model in ``xml``."""
    reading = read_model(xml.encode(), "model.xml")
    assert not reading.problems, reading.problems
    return reading.model


TELLER = """<Model>
  <PlatformModule name="bank_platform">
    <InteractionModule name="services">
      <ContractModule name="contracts">
        <AbstractInterface name="service_intf_t"/>
      </ContractModule>
      <ContractModule name="data">
        <AbstractDataType name="message_type_t"/>
      </ContractModule>
      <InteractionPattern name="service">
        <InteractionRole name="client" lowerMultiplicity="1" upperMultiplicity="-1"/>
      </InteractionPattern>
      <PortType name="service_server_tport">
        <PortElement name="api" interface="contracts::service_intf_t" kind="PROVIDED"/>
      </PortType>
      <PortType name="service_client_tport">
        <PortElement name="api" interface="contracts::service_intf_t" kind="REQUIRED"/>
      </PortType>
    </InteractionModule>
    <NonfunctionalAspectModule name="policy_mod">
      <ContractModule name="api">
        <Interface name="component_execution_intf"><Method name="run"/></Interface>
        <Interface name="trace_intf"><Method name="note"/></Interface>
      </ContractModule>
      <TechnicalAspect name="duty" multiplicity="anyNumber"/>
      <TechnicalPolicyDefinition name="self-executing" technicalAspect="duty" applicability="onComponent">
        <PortElement name="self-execution_api" interface="api::component_execution_intf" kind="PROVIDED"/>
      </TechnicalPolicyDefinition>
      <TechnicalPolicyDefinition name="trace" technicalAspect="duty" applicability="onComponent">
        <PortElement name="trace_api" interface="api::trace_intf" kind="REQUIRED"/>
      </TechnicalPolicyDefinition>
      <ProgrammingLanguages><Language name="cpp"/></ProgrammingLanguages>
    </NonfunctionalAspectModule>
  </PlatformModule>
  <ApplicationModule name="bank">
    <ContractModule name="types">
      <PrimitiveInteger name="id_t" kind="SHORT"/>
      <Interface name="HelloInterface"><Method name="hello"/></Interface>
    </ContractModule>
    <ComponentModule name="desk">
      <ComponentType name="TellerComponent">
        <Attribute name="id" mode="READ" type="::bank::types::id_t"/>
        <Port name="teller">
          <PortTypeSpec type="::bank_platform::services::service_server_tport">
            <AbstractTypeBinding abstractType="::bank_platform::services::contracts::service_intf_t"
                                 actualType="::bank::types::HelloInterface"/>
          </PortTypeSpec>
        </Port>
      </ComponentType>
      <ComponentType name="PrinterComponent">
        <Port name="printer">
          <PortTypeSpec type="::bank_platform::services::service_client_tport">
            <AbstractTypeBinding abstractType="::bank_platform::services::contracts::service_intf_t"
                                 actualType="::bank::types::HelloInterface"/>
          </PortTypeSpec>
        </Port>
        <Port name="asked"><PortRoleSpec role="::bank_platform::services::service.client"/></Port>
      </ComponentType>
      <ComponentTechnicalPolicy name="ExecPolicy" technicalPolicyDefinition="::bank_platform::policy_mod::self-executing">
        <ManagedComponent name="TellerComponentImpl"/>
      </ComponentTechnicalPolicy>
      <ComponentTechnicalPolicy name="TracePolicy" technicalPolicyDefinition="::bank_platform::policy_mod::trace">
        <ManagedComponent name="TellerComponentImpl"/>
      </ComponentTechnicalPolicy>
      <AtomicComponentImplementation name="TellerComponentImpl" type="TellerComponent" language="cpp">
        <TechnicalPolicy name="ExecPolicy"/>
        <TechnicalPolicy name="TracePolicy"/>
      </AtomicComponentImplementation>
      <AtomicComponentImplementation name="PrinterComponentImpl" type="PrinterComponent" language="cpp"/>
    </ComponentModule>
  </ApplicationModule>
</Model>"""
"""The components that clause 12 tells its rules with."""

TELLER_IDL = """interface PortElementObject { };
interface ComponentObject;
module bank_platform {
  module services<interface SERVICE_INTF_T> {
    module contracts<interface SERVICE_INTF_T> { };
    module data<typename MESSAGE_TYPE_T> { };
  };
  module policy_mod { module api {
    interface component_execution_intf { void run(); };
    interface trace_intf : PortElementObject { void note(); };
  }; };
};
module bank {
  module types {
    typedef short id_t;
    interface HelloInterface : PortElementObject { void hello(); };
  };
  module desk {
    interface TellerComponent {
      readonly attribute types::id_t id;
      types::HelloInterface get_teller_api();
    };
    interface PrinterComponent { };
    interface TellerComponentImpl_Body : ComponentObject, TellerComponent {
      bank_platform::policy_mod::api::component_execution_intf get_tp_TellerExecPolicy_self_execution_api();
    };
    interface PrinterComponentImpl_Body : PrinterComponent, ComponentObject { };
  };
};
"""
"""Their IDL by hand, after the examples of 12.7 and 12.8."""


NO_HEADERS = Headers(Path("/nowhere"), ())
PROFILES: Mapping[Standard, tuple[str, ...]] = {"cpp11": ("cpp", "cpp11"), "cpp03": ("cpp", "cpp03")}


@functools.cache
def model(name: str) -> Model:
    path = SUITE / "models" / "mapping" / f"{name}.xml"
    reading = read_model(path.read_bytes(), path.name)
    assert reading.problems == ()
    return reading.model


def expectations(name: str, standard: Standard = "cpp11", **readings: str) -> ExpectedCpp:
    declared = {option.replace("_", "-"): value for option, value in readings.items()}
    return expected_cpp(model(name), standard, declared)
