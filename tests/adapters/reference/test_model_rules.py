"""Rules of the reference tool chain where cases would be too large, and helpers that several rules share."""

from __future__ import annotations

import pytest

from ucm_cts.adapters.reference.toolchain.program import reference

PROGRAM = reference()


def reported(model: str) -> set[str]:
    """The requirements that ``model`` breaks."""
    return {diagnostic.requirement for diagnostic in PROGRAM.check(model.encode(), "model.xml")[1]}


def chain(length: int, last: str, parent: str) -> str:
    """A module of ``length`` declarations made of ``last``, each but the first one naming the one before as its ``parent``."""
    named = "".join(parent.format(name=f"n{n}", before=f"n{n - 1}") for n in range(1, length))
    return last.format(name="n0", end=f"n{length - 1}") + named


INTERFACE = '<Interface name="{name}"><InheritedInterface interface="{before}"/></Interface>'
PATTERN = '<InteractionPattern name="{name}" extends="{before}"/>'


@pytest.mark.parametrize(
    ("module", "open_end", "closed_end", "parent", "requirement"),
    [
        (
            "ContractModule",
            '<Interface name="{name}"/>',
            '<Interface name="{name}"><InheritedInterface interface="{end}"/></Interface>',
            INTERFACE,
            "R-9.2.7.1-05",
        ),
        (
            "InteractionModule",
            '<InteractionPattern name="{name}"/>',
            '<InteractionPattern name="{name}" extends="{end}"/>',
            PATTERN,
            "R-9.3.3.2-06",
        ),
    ],
)
def test_long_chains_are_followed_to_their_end(
    module: str, open_end: str, closed_end: str, parent: str, requirement: str
) -> None:
    def around(inside: str) -> str:
        return f'<{module} name="m">{inside}</{module}>'

    assert reported(around(chain(300, open_end, parent))) == set()
    assert reported(around(chain(300, closed_end, parent))) == {requirement}


HANDLING = """
<InteractionModule name="im">
  <ContractModule name="c">
    <PrimitiveBoolean name="sent_t"/>
    <PrimitiveBoolean name="other_t"/>
    <Alias name="alias_t" type="{inner}"/>
    <Sequence name="sequence_t" type="alias_t" indexType="ULONG" maxSize="-1"/>
    <Structure name="structure_t"><StructureField name="f" type="sequence_t"/></Structure>
    <Array name="array_t" type="structure_t"><ArrayDimension indexType="ULONG" size="2"/></Array>
    <Interface name="helper"><Method name="h"><Parameter name="p" direction="OUT" type="array_t"/></Method></Interface>
    <Interface name="in"><Attribute name="a" type="helper" mode="READ"/></Interface>
    <Interface name="out"><Method name="f"><Parameter name="p" direction="IN" type="sent_t"/></Method></Interface>
  </ContractModule>
  <InteractionPattern name="pat">
    <InteractionRole name="a" lowerMultiplicity="1" upperMultiplicity="1"><InvolvedItem item="x"/></InteractionRole>
    <InteractionRole name="b" lowerMultiplicity="1" upperMultiplicity="1"><InvolvedItem item="x"/></InteractionRole>
    <InteractionItem name="x" nature="DATA"/>
  </InteractionPattern>
  <PortType name="sends"><PortElement name="e" interface="c::out" kind="REQUIRED"/></PortType>
  <PortType name="receives"><PortElement name="e" interface="c::in" kind="PROVIDED"/></PortType>
  <ConnectorDefinition name="con" pattern="pat">
    <ConnectorPort name="p" portRole="pat.a" api="sends"/>
    <ConnectorPort name="q" portRole="pat.b" api="receives"/>
    <ItemBinding interactionItem="pat.x" connectorItem="c::sent_t"/>
  </ConnectorDefinition>
</InteractionModule>
"""


def test_a_port_handles_the_parts_of_its_types() -> None:
    assert reported(HANDLING.format(inner="sent_t")) == set()
    assert reported(HANDLING.format(inner="other_t")) == {"R-9.3.3.4-07"}


def test_values_of_parameters_are_read_where_the_parameter_is_declared() -> None:
    model = """
    <ContractModule name="m">
      <ContractModule name="notes">
        <Enumeration name="colour" indexType="UBYTE"><Enumerator name="red" value="0"/></Enumeration>
        <AnnotationDefinition name="note"><ConfigurationParameter name="paint" type="colour"/></AnnotationDefinition>
      </ContractModule>
      <Interface name="i">
        <Annotation annotationDefinition="notes::note">
          <ConfigurationParameterValue configurationParameter="notes::note.paint" value="{value}"/>
        </Annotation>
      </Interface>
    </ContractModule>
    """
    assert reported(model.format(value="red")) == set()
    assert reported(model.format(value="green")) == {"R-9.2.9.2-03"}
