// What the schema of experiments allows at a place.

export class Schema {
  constructor(schema) { this.root = schema; }

  // All alternatives of a schema that the value there does not rule out by its `type`.
  alternatives(schema, value) {
    if (!schema || typeof schema !== 'object') return [];
    if (schema.$ref) {
      const {$ref, ...rest} = schema;
      const target = $ref.split('/').slice(1).reduce((at, part) => at[part], this.root);
      return this.alternatives({...target, ...rest}, value);
    }
    const choices = schema.oneOf || schema.anyOf;
    if (!choices) return [schema];
    const all = choices.flatMap((one) => this.alternatives(one, value));
    const type = value && typeof value === 'object' ? value.type : undefined;
    if (typeof type !== 'string') return all;
    const fitting = all.filter((one) => this.types(one).includes(type));
    return fitting.length > 0 ? fitting : all;
  }

  types(schema) {
    const type = schema.properties && schema.properties.type;
    return type ? this.values(type) : [];
  }

  at(path, value) {
    let schemas = this.alternatives(this.root, value);
    for (const step of path) {
      value = value && typeof value === 'object' ? value[step] : undefined;
      schemas = schemas.flatMap((schema) => {
        if (typeof step === 'number') return this.alternatives(schema.items, value);
        const named = schema.properties && schema.properties[step];
        if (named) return this.alternatives(named, value);
        return typeof schema.additionalProperties === 'object' ? this.alternatives(schema.additionalProperties, value) : [];
      });
    }
    return schemas;
  }

  // [{key, description}] at an object.
  keys(path, value) {
    const found = new Map();
    for (const schema of this.at(path, value)) {
      for (const [key, one] of Object.entries(schema.properties || {}))
        if (!found.has(key) && !key.startsWith('$')) found.set(key, {key, description: one.description || ''});
    }
    return [...found.values()];
  }

  values(schema) {
    if (schema.const !== undefined) return [schema.const];
    if (schema.enum) return schema.enum;
    return (schema.oneOf || schema.anyOf || []).flatMap((one) => this.values(one));
  }

  // Words that may stand at a place: {value, description}.
  words(path, value) {
    const parent = path.slice(0, -1), found = new Map();
    const add = (word, description) => {
      if (typeof word === 'string' && !found.has(word)) found.set(word, {value: word, description});
    };
    if (path[path.length - 1] === 'type') {
      const holder = parent.reduce((at, step) => at && at[step], value);
      const without = holder && typeof holder === 'object' ? {...holder, type: undefined} : holder;
      const root = parent.length === 0 ? without : value;
      let schemas = this.alternatives(this.root, root), at = value;
      for (const [i, step] of parent.entries()) {
        at = i === parent.length - 1 ? without : at && at[step];
        schemas = schemas.flatMap((one) => typeof step === 'number' ? this.alternatives(one.items, at)
          : this.alternatives((one.properties || {})[step] || (typeof one.additionalProperties === 'object' ? one.additionalProperties : null), at));
      }
      for (const schema of schemas) for (const word of this.types(schema)) add(word, schema.description || '');
    }
    for (const schema of this.at(path, value)) {
      for (const word of this.values(schema)) add(word, schema.description || '');
      for (const word of this.types(schema)) if (!(schema.required || []).some((key) => key !== 'type')) add(word, schema.description || '');
      if (schema.type === 'boolean') { found.set('true', {value: true}); found.set('false', {value: false}); }
    }
    return [...found.values()];
  }
}
