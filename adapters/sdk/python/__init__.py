"""The Python SDK: everything an adapter needs beside a subclass of ``adapters.contract.adapter.Adapter``.

``recorder`` numbers events, ``gates`` and ``workers`` are the scenario's threads, ``probe`` holds the bodies, ``engine``
runs one scenario, ``operations`` calls the adapter for it, ``host`` serves an adapter to the harness, and ``template`` forks a
process for each host.
"""
