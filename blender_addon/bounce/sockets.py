# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading shader node sockets. Works on any object with Blender's node attributes."""


def output_node(tree, output_type="OUTPUT_MATERIAL"):
    """The active output that Cycles uses."""
    outputs = [node for node in tree.nodes if node.type == output_type and node.is_active_output]
    for node in outputs:
        if getattr(node, "target", "ALL") in {"ALL", "CYCLES"}:
            return node
    return None


def source(socket):
    """(node, output socket) that feeds this input, past reroutes; or (None, None)."""
    while socket.is_linked:
        link = socket.links[0]
        if link.is_muted:
            break
        node, output = link.from_node, link.from_socket
        if node.type == "REROUTE":
            socket = node.inputs[0]
            continue
        return node, output
    return None, None


def surface_node(tree, output_type="OUTPUT_MATERIAL"):
    output = output_node(tree, output_type)
    return None if output is None else source(output.inputs["Surface"])[0]


def constant(socket):
    """A float or a list of three; None where a node that is no constant feeds it."""
    node, output = source(socket)
    if node is not None:
        if node.type not in {"RGB", "VALUE"}:
            return None
        socket = output
    return unconnected(socket)


def unconnected(socket):
    """The value that the socket itself holds."""
    value = socket.default_value
    return [float(c) for c in value][:3] if hasattr(value, "__len__") else float(value)


def first_unreadable(node):
    """Words for the node, or for the first of its inputs that is no constant."""
    for socket in node.inputs:
        feeding = source(socket)[0]
        if feeding is not None and constant(socket) is None:
            return f"{socket.name} comes from {describe(feeding)}"
    return describe(node)


def describe(node):
    """'Noise Texture', or 'Node Group "Rust"': what the user sees in the editor."""
    label = getattr(node, "bl_label", node.type)
    if node.type == "GROUP" and node.node_tree is not None:
        return f"{label} '{node.node_tree.name}'"
    return label
